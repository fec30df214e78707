list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/drawn_scenes_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/edge_advice_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/optimise_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/grinding_choices_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/life_error_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/other_flank_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/twist_compensation_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/results_store_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/scatter_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/scatter_results_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/assessment_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/assessment_results_test.cpp)
