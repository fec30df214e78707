list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/finite_elements_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/run_cache_test.cpp)
