# Installs a build into an empty folder, builds the consumer project with it and runs it.
#   cmake -D BUILD=... -D SOURCE=... -D FOLDER=... -D COMPILER=... -D TYPE=... -P check.cmake
function(run)
  execute_process(COMMAND ${ARGV} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/installed)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE} -B ${FOLDER}/consumer -D CMAKE_PREFIX_PATH=${FOLDER}/installed -D CMAKE_CXX_COMPILER=${COMPILER}
    -D CMAKE_BUILD_TYPE=${TYPE})
run(${CMAKE_COMMAND} --build ${FOLDER}/consumer)
run(${FOLDER}/consumer/consumer)
if(NOT said MATCHES "^[0-9.]+ 90 1\n$")
  message(FATAL_ERROR "the consumer says: ${said}")
endif()
foreach(file IN ITEMS bin/flankwright share/man/man1/flankwright.1 share/bash-completion/completions/flankwright
        share/zsh/vendor-completions/_flankwright)
  if(NOT EXISTS ${FOLDER}/installed/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
file(REMOVE_RECURSE ${FOLDER})
