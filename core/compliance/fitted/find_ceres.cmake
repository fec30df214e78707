# Ceres::ceres, on whatever libblas the system has chosen (BLA_VENDOR Generic). Ceres' Debian package brings ATLAS and names its
# files; an executable that links them takes CHOLMOD's products from there too, and a finite-element run takes twice as long as with
# OpenBLAS.
if(NOT DEFINED BLA_VENDOR)
  set(BLA_VENDOR Generic)
endif()
find_package(Ceres REQUIRED)
get_target_property(links_of_ceres Ceres::ceres INTERFACE_LINK_LIBRARIES)
list(FILTER links_of_ceres EXCLUDE REGEX "/lib(f77blas|atlas)\\.(so|a)$")
set_target_properties(Ceres::ceres PROPERTIES INTERFACE_LINK_LIBRARIES "${links_of_ceres}")
