# Fails where an include runs against the flow of the house:
#
#   cmake -D ROOT=<source tree> -P layering.cmake          checks a tree
#   cmake -D SELF_TEST=<scratch folder> -P layering.cmake  checks the check, on a tree with one include of every kind
#
# A folder sees itself and those before it in this list. Folders of core that are not in the list are an error.
cmake_minimum_required(VERSION 3.25)

set(FLOW core/base core/gear core/flank core/contact core/compliance core/effects core/load optimize studies)

# The place in FLOW of the folder that `path` (from the root) lies in, -1 where it lies in none.
function(find_layer path result)
  set(${result} -1 PARENT_SCOPE)
  set(index 0)
  foreach(folder IN LISTS FLOW)
    string(FIND "${path}" "${folder}/" position)
    if(position EQUAL 0)
      set(${result} ${index} PARENT_SCOPE)
      return()
    endif()
    math(EXPR index "${index} + 1")
  endforeach()
endfunction()

# What is wrong with the includes below `root`, a list of "file: ..." messages.
function(check_includes root result)
  set(problems)
  file(GLOB_RECURSE files RELATIVE ${root} ${root}/core/*.[hc]pp ${root}/optimize/*.[hc]pp ${root}/studies/*.[hc]pp)
  foreach(file IN LISTS files)
    find_layer(${file} layer)
    if(layer EQUAL -1)
      list(APPEND problems "${file}: lies in no folder of the flow")
      continue()
    endif()
    get_filename_component(folder ${root}/${file} DIRECTORY)
    file(STRINGS ${root}/${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^[^<\"]*[<\"]([^>\"]*)[>\"].*$" "\\1" included "${line}")
      find_layer(${included} included_layer)
      if(included_layer GREATER layer)
        list(APPEND problems "${file}: upward include of ${included}")
      elseif(included MATCHES "^tests/")
        list(APPEND problems "${file}: includes a test, ${included}")
      elseif(included_layer EQUAL -1 AND EXISTS ${folder}/${included})
        list(APPEND problems "${file}: ${included} is not included from the root")
      endif()
    endforeach()
  endforeach()
  set(${result} "${problems}" PARENT_SCOPE)
endfunction()

if(DEFINED SELF_TEST)
  file(REMOVE_RECURSE ${SELF_TEST})
  file(WRITE ${SELF_TEST}/core/base/error.hpp "#include <string>\n")
  file(WRITE ${SELF_TEST}/core/gear/gear.hpp "#include \"core/base/error.hpp\"\n#include \"core/load/load.hpp\"\n")
  file(WRITE ${SELF_TEST}/core/load/load.hpp "#  include <optimize/solver.hpp>\n#include \"core/gear/gear.hpp\"\n")
  file(WRITE ${SELF_TEST}/core/load/load.cpp "#include \"load.hpp\"\n#include \"../gear/gear.hpp\"\n")
  file(WRITE ${SELF_TEST}/core/odd/odd.hpp "\n")
  file(WRITE ${SELF_TEST}/optimize/solver.hpp "#include \"studies/study.hpp\"\n// #include \"studies/study.hpp\"\n")
  file(WRITE ${SELF_TEST}/studies/study.hpp "#include \"optimize/solver.hpp\"\n#include \"tests/problems/box.hpp\"\n")
  check_includes(${SELF_TEST} found)
  set(expected
      "core/gear/gear.hpp: upward include of core/load/load.hpp"
      "core/load/load.cpp: load.hpp is not included from the root"
      "core/load/load.cpp: ../gear/gear.hpp is not included from the root"
      "core/load/load.hpp: upward include of optimize/solver.hpp"
      "core/odd/odd.hpp: lies in no folder of the flow"
      "optimize/solver.hpp: upward include of studies/study.hpp"
      "studies/study.hpp: includes a test, tests/problems/box.hpp")
  if(NOT found STREQUAL expected)
    list(JOIN found "\n  " found)
    list(JOIN expected "\n  " expected)
    message(FATAL_ERROR "The check found\n  ${found}\ninstead of\n  ${expected}")
  endif()
else()
  check_includes(${ROOT} found)
  if(found)
    list(JOIN found "\n  " found)
    message(FATAL_ERROR "Includes against the flow:\n  ${found}")
  endif()
endif()
