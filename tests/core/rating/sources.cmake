list(APPEND FLANKWRIGHT_TEST_SOURCES
     ${CMAKE_CURRENT_LIST_DIR}/contact_peaks_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/iso_load_factors_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/line_ends_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_factors_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/load_sharing_test.cpp
     ${CMAKE_CURRENT_LIST_DIR}/peak_gradient_test.cpp)
