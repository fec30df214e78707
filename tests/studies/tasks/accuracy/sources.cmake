list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/accuracy_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/fidelity_hierarchy_test.cpp)
