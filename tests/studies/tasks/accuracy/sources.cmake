list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/fidelity_choice_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/ladder_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/model_honesty_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/stated_accuracy_test.cpp)
