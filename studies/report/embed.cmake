# Turns the page's files into one C++ source of raw string literals. Run with -P and
# PAGE (folder), SCRIPTS (list, in order), CHART (plot library), OUTPUT (source to write).
set(delimiter "asset_end")

# Appends `constexpr` text of the given files, one after the other, as the string view NAME.
function(embed name)
  set(text "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" content)
    string(FIND "${content}" ")${delimiter}\"" clash)
    if(NOT clash EQUAL -1)
      message(FATAL_ERROR "${file} contains the delimiter of its raw string")
    endif()
    string(APPEND text "${content}")
  endforeach()
  file(APPEND "${OUTPUT}.part" "const std::string_view ${name} = R\"${delimiter}(${text})${delimiter}\";\n\n")
endfunction()

file(WRITE "${OUTPUT}.part" "#include \"studies/report/report_assets.hpp\"\n\nnamespace flankwright::studies::assets {\n\n")
embed(page_html "${PAGE}/report.html")
embed(page_css "${PAGE}/report.css")
embed(page_script ${SCRIPTS})
embed(page_main "${PAGE}/main.js")
embed(comparison_script "${PAGE}/compared_runs.js")
embed(chart_library "${CHART}")
embed(notices "${PAGE}/notices.txt")
file(APPEND "${OUTPUT}.part" "}  // namespace flankwright::studies::assets\n")
file(RENAME "${OUTPUT}.part" "${OUTPUT}")
