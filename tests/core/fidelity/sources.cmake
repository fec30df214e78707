list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/cycle_error_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/cycle_extremes_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/cycle_resolution_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/curve_rise_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/resolved_analysis_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/effect_sizes_test.cpp)
