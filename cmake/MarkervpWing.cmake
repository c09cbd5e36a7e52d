# markervp_wing(NAME): the current folder is a wing of the platform, whose headers are included as <NAME/…>. A target that
# publishes MARKERVP_WING_ROOT shows this wing alone: a file includes what its target links, and nothing else of the platform.
# markervp_NAME_wing has the headers alone, for plug-ins that link nothing.
function(markervp_wing NAME)
  set(root "${PROJECT_BINARY_DIR}/roots/${NAME}")
  file(MAKE_DIRECTORY "${root}")
  file(CREATE_LINK "${CMAKE_CURRENT_SOURCE_DIR}" "${root}/${NAME}" SYMBOLIC)
  set(MARKERVP_WING_ROOT "${root}" PARENT_SCOPE)
  add_library(markervp_${NAME}_wing INTERFACE)
  target_include_directories(markervp_${NAME}_wing INTERFACE "${root}")
endfunction()

# The current folder works once in a run, not for each frame: optimised lightly, it compiles in half the time.
macro(markervp_optimise_lightly)
  string(REPLACE "-O3" "-Og" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
endmacro()
