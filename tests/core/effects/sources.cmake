list(APPEND FLANKWRIGHT_TEST_SOURCES ${CMAKE_CURRENT_LIST_DIR}/contact_coupling_test.cpp ${CMAKE_CURRENT_LIST_DIR}/decision_test.cpp ${CMAKE_CURRENT_LIST_DIR}/free_ends_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/mesh_effects_test.cpp)
