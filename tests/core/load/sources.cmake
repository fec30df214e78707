list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/cholesky_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/condition_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/cycle_figures_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/cycle_gradient_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/edge_contact_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/edge_cost_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/face_end_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/line_crest_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/haddad_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_cases.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_problem_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_solver_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_start_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/mesh_cycle_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/mesh_model_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/mesh_motion_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/mesh_stiffness_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/mesh_symmetry_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/quadratic_program_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/random_load_problems_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/root_stress_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sensitivity_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/shafts_under_load_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/surface_cycle_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/surface_outputs_test.cpp)
list(APPEND FLANKWRIGHT_TEST_SOURCES ${CMAKE_CURRENT_LIST_DIR}/many_teeth_test.cpp)
