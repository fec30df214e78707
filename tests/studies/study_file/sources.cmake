list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/shaft_part_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/given_units_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/grid_file_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/key_page_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/modification_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/signal_file_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_bodies_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_file_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_flanks_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_life_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_mutation_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_problems_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_shafts_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_unit_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/unit_life_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_syntax_test.cpp)
