# mvo::core, mvo::sim and mvo::data for those who find_package(mvo), with ROS or without.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(OpenCV COMPONENTS calib3d core features2d imgcodecs imgproc video videoio)
include("${CMAKE_CURRENT_LIST_DIR}/mvoTargets.cmake")
