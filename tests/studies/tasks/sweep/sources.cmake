list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/run_sweep_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/shards_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sweep_command_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sweep_keys_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sweep_report_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sweep_statistics_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sweep_store_test.cpp)
