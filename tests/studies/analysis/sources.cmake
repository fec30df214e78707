list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/default_resolution_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/edge_error_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/fidelity_choice_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/governing_cases_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/grinding_process_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/model_honesty_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/position_memory_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/run_study_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/stated_accuracy_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/stress_factors_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_effect_sizes_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_effects_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_notes_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/tooth_thickness_study_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/wide_error_note_test.cpp)
