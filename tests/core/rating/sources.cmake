list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/contact_peaks_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/contact_temperature_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/damage_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/film_thickness_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/iso_load_factors_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/iso_stress_numbers_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/line_ends_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_factors_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_sharing_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_signal_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/material_strength_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/peak_gradient_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/rainflow_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sliding_loss_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/sn_curve_test.cpp)
