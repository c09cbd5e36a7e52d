# Linear algebra, here as on the chip. Without vector instructions all hosts add in the same order, so results agree bit for
# bit; without its assertions nothing is printed where there is no console.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
add_library(markervp_eigen INTERFACE)
target_link_libraries(markervp_eigen INTERFACE Eigen3::Eigen)
target_compile_definitions(markervp_eigen INTERFACE EIGEN_DONT_VECTORIZE EIGEN_NO_DEBUG EIGEN_MPL2_ONLY)
