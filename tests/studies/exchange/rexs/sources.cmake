list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/gear_train.cpp
     ${CMAKE_CURRENT_LIST_DIR}/grouped_warnings_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_archive_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_commands_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_defects_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_errors_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_export_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_import_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_load_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_mesh_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_model_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_shaft_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_spectrum_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rexs_unit_test.cpp)
