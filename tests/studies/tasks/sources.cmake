list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/default_resolution_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_effect_sizes_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/run_study_test.cpp)
