list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/command_line.cpp
     ${CMAKE_CURRENT_LIST_DIR}/examples_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/laws_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sample_results.cpp
     ${CMAKE_CURRENT_LIST_DIR}/small_studies.cpp
     ${CMAKE_CURRENT_LIST_DIR}/study_texts.cpp)
