list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/design_aggregate_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_optimiser_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_outputs_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_problem_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_programs_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_tasks.cpp)
