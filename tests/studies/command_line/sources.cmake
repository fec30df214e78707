list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/command_docs_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/compare_command_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/commands_test.cpp)
