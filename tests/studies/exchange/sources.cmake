list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/grid_table_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/vtk_series_test.cpp)
