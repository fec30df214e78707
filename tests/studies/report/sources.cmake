list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/report_names_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/report_test.cpp)
