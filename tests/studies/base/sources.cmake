list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/results_folder_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/unit_of_name_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/value_with_unit_test.cpp)
