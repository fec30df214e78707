# What `cmake --install` and the Debian packages contain: the program with its manual page, completions, pages and examples (flankwright),
# the libraries with headers and CMake configuration (flankwright-dev), and the Python package (python3-flankwright). Included from the root, which relative paths count from.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(headers ${CMAKE_INSTALL_INCLUDEDIR}/flankwright)  # files include each other from this root: "core/gear/gear_pair.hpp"
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/flankwright)
foreach(library IN ITEMS core optimize report studies)
  set_target_properties(flankwright_${library} PROPERTIES EXPORT_NAME ${library})
  target_include_directories(flankwright_${library} INTERFACE $<INSTALL_INTERFACE:${headers}>)
  target_compile_features(flankwright_${library} PUBLIC cxx_std_20)
  install(TARGETS flankwright_${library} EXPORT flankwright ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
endforeach()
install(DIRECTORY core optimize studies DESTINATION ${headers} COMPONENT dev FILES_MATCHING PATTERN "*.hpp" PATTERN examples EXCLUDE
        PATTERN page EXCLUDE PATTERN library EXCLUDE PATTERN python EXCLUDE)
install(EXPORT flankwright NAMESPACE flankwright:: FILE flankwright-targets.cmake DESTINATION ${config} COMPONENT dev)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/flankwright-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES .cmake/flankwright-config.cmake core/compliance/fitted/find_ceres.cmake ${PROJECT_BINARY_DIR}/flankwright-config-version.cmake DESTINATION ${config} COMPONENT dev)

install(TARGETS flankwright RUNTIME COMPONENT program)
install(DIRECTORY studies/examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program PATTERN pictures EXCLUDE)
install(FILES CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)  # the pages are installed in HTML, below

# The Python package, where Debian's Python looks for it below /usr; below other prefixes PYTHONPATH leads there.
if(FLANKWRIGHT_HAS_PYTHON)
  set(python_packages lib/python3/dist-packages)
  install(TARGETS flankwright_python LIBRARY DESTINATION ${python_packages}/flankwright COMPONENT python)
  install(DIRECTORY studies/python/flankwright DESTINATION ${python_packages} COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
endif()

# Manual page and completions are what the program says of itself.
set(docs ${PROJECT_BINARY_DIR}/docs)
add_custom_command(
  OUTPUT ${docs}/flankwright.1 ${docs}/flankwright ${docs}/_flankwright
  COMMAND ${CMAKE_COMMAND} -E make_directory ${docs}
  COMMAND flankwright completion man > ${docs}/flankwright.1
  COMMAND flankwright completion bash > ${docs}/flankwright
  COMMAND flankwright completion zsh > ${docs}/_flankwright
  DEPENDS flankwright
  COMMENT "Writing the manual page and the completions"
  VERBATIM)
# The pages in HTML, with what they lead to. The program finds them from where it lies.
file(GLOB_RECURSE pages CONFIGURE_DEPENDS *.md)
list(FILTER pages EXCLUDE REGEX "${PROJECT_SOURCE_DIR}/(build|results)/")
add_custom_command(
  OUTPUT ${docs}/html/README.html
  COMMAND flankwright_pages ${PROJECT_SOURCE_DIR} ${docs}/html
  DEPENDS flankwright_pages ${pages}
  COMMENT "Writing the pages in HTML"
  VERBATIM)
file(RELATIVE_PATH pages_from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DOCDIR}/html)
target_compile_definitions(flankwright PRIVATE FLANKWRIGHT_PAGES="${pages_from_program}")
install(DIRECTORY ${docs}/html DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
add_custom_target(flankwright_docs ALL DEPENDS ${docs}/flankwright.1 ${docs}/flankwright ${docs}/_flankwright ${docs}/html/README.html)
install(FILES ${docs}/flankwright.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${docs}/flankwright DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${docs}/_flankwright DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)

# cpack -G DEB
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME flankwright)
set(CPACK_PACKAGE_CONTACT "The Flankwright authors")
set(CPACK_PACKAGE_VENDOR Flankwright)
set(CPACK_COMPONENTS_ALL program dev)
if(FLANKWRIGHT_HAS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME flankwright)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS libopenblas0-pthread)  # reference BLAS takes many times as long
set(CPACK_DEBIAN_DEV_PACKAGE_NAME flankwright-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libnlopt-dev, libnlopt-cxx-dev, coinor-libipopt-dev, libtbb-dev, libsuitesparse-dev, libblas-dev | libblas.so, \
libceres-dev, libfmt-dev, libspdlog-dev, libsqlite3-dev, libpugixml-dev, libzip-dev, libtomlplusplus-dev, nlohmann-json3-dev, pkg-config")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-flankwright)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS libopenblas0-pthread)
# The summary is the project's; CPack indents.
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Flank modifications of spur and helical gears, designed over the whole set
of misalignments: tooth contact analysis, loaded contact, optimisation.")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Libraries and headers: geometry, contact, compliance, load distribution and
optimisation in C++20 for find_package(flankwright).")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Studies from Python: checks, analyses, optimisations and sweeps of gear pairs
with results and derivatives as NumPy arrays.")
include(CPack)
