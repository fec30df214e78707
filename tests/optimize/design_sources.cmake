list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/deciding_positions_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/deciding_scenes_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_aggregate_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_optimiser_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_outputs_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_problem_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_programs_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/design_tasks.cpp
     ${CMAKE_CURRENT_LIST_DIR}/grindable_design_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/least_excess_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/life_outputs_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/mesh_store_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/multi_start_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/nonnegative_least_squares_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/optimality_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/pareto_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/random_problems_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rounding_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/draws_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/scatter_search_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/linking_constraints_test.cpp)
list(APPEND FLANKWRIGHT_TEST_SOURCES ${CMAKE_CURRENT_LIST_DIR}/between_positions_test.cpp)
list(APPEND FLANKWRIGHT_TEST_SOURCES ${CMAKE_CURRENT_LIST_DIR}/spare_limits_test.cpp)
