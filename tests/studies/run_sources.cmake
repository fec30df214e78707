list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/command_line.cpp
     ${CMAKE_CURRENT_LIST_DIR}/commands_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/examples_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/expectations_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/finite_elements_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/fit_results_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/gradients_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/grid_file_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/optimise_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/results_folder_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/results_store_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/run_cache_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/run_study_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/small_studies.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_shafts_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/tables_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/unloaded_results_test.cpp)
