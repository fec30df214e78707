list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/optimum_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/relaxation_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rules_of_thumb_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/usual_signs_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/variant_search_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/predicted_statistic_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/validation_test.cpp)
