list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/fit_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/fit_results_test.cpp)
