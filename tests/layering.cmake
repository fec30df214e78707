# Fails where an include runs against the flow of the house:
#
#   cmake -D ROOT=<source tree> -P layering.cmake          checks a tree
#   cmake -D SELF_TEST=<scratch folder> -P layering.cmake  checks the check, on a tree with one include of every kind
#
# A folder sees itself and those before it in this list; of nested folders the innermost in the list counts. A folder of core that is not in
# the list is an error.
cmake_minimum_required(VERSION 3.25)

set(FLOW core/base core/gear core/flank
    core/contact/path core/contact/assembly core/contact/unloaded core/contact/gap
    core/compliance/local core/compliance/tooth core/compliance/thin_slice core/compliance/finite_element core/compliance/pair
    core/compliance/fitted core/compliance/plate core/compliance/shaft core/compliance/comparison core/compliance/model
    core/effects core/load/solve core/load/cycle core/rating core/fidelity
    optimize/solvers optimize/sampling
    optimize/design/outputs optimize/design/problem optimize/design/search optimize/design/grinding optimize/design optimize/design/scatter optimize/assessment
    studies/base studies/study studies/compliance studies/study_file studies/analysis studies/results
    studies/tasks/analyse studies/tasks/optimise studies/tasks/sweep studies/tasks/accuracy studies/tasks/fit studies/tasks/geometry
    studies/tasks
    studies/report studies/comparison studies/exchange studies/pages studies/command_line studies/python studies)

# The place in FLOW of the folder that `path` (from the root) lies in, -1 where it lies in none.
function(find_layer path result)
  set(${result} -1 PARENT_SCOPE)
  set(index 0)
  set(innermost 0)
  foreach(folder IN LISTS FLOW)
    string(FIND "${path}" "${folder}/" position)
    string(LENGTH "${folder}" length)
    if(position EQUAL 0 AND length GREATER innermost)
      set(${result} ${index} PARENT_SCOPE)
      set(innermost ${length})
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
  file(WRITE ${SELF_TEST}/core/gear/gear.hpp "#include \"core/base/error.hpp\"\n#include \"core/load/cycle/load.hpp\"\n")
  file(WRITE ${SELF_TEST}/core/load/cycle/load.hpp "#  include <optimize/solvers/solver.hpp>\n#include \"core/gear/gear.hpp\"\n")
  file(WRITE ${SELF_TEST}/core/load/cycle/load.cpp "#include \"load.hpp\"\n#include \"../../gear/gear.hpp\"\n")
  file(WRITE ${SELF_TEST}/core/odd/odd.hpp "\n")
  file(WRITE ${SELF_TEST}/optimize/solvers/solver.hpp "#include \"studies/study/study.hpp\"\n// #include \"studies/study/study.hpp\"\n")
  file(WRITE ${SELF_TEST}/studies/study/study.hpp "#include \"tests/problems/box.hpp\"\n#include \"studies/tasks/sweep/sweep.hpp\"\n")
  file(WRITE ${SELF_TEST}/studies/tasks/sweep/sweep.hpp "#include \"studies/tasks/run.hpp\"\n")
  file(WRITE ${SELF_TEST}/studies/tasks/run.hpp "#include \"studies/tasks/sweep/sweep.hpp\"\n")
  check_includes(${SELF_TEST} found)
  set(expected
      "core/gear/gear.hpp: upward include of core/load/cycle/load.hpp"
      "core/load/cycle/load.cpp: load.hpp is not included from the root"
      "core/load/cycle/load.cpp: ../../gear/gear.hpp is not included from the root"
      "core/load/cycle/load.hpp: upward include of optimize/solvers/solver.hpp"
      "core/odd/odd.hpp: lies in no folder of the flow"
      "optimize/solvers/solver.hpp: upward include of studies/study/study.hpp"
      "studies/study/study.hpp: includes a test, tests/problems/box.hpp"
      "studies/study/study.hpp: upward include of studies/tasks/sweep/sweep.hpp"
      "studies/tasks/sweep/sweep.hpp: upward include of studies/tasks/run.hpp")
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
