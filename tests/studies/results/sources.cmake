list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/drawing_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/expectations_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/gathered_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/gradients_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/life_gradients_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/life_quantities_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/quantities_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/report_tables_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/tables_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/unloaded_results_test.cpp)
