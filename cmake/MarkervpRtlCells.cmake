# Cells of the vendor's that RTL instantiates without a source: our models of them (models/xilinx/cells), in this tree or installed. Modules
# of the user's own with the same name go before them.
if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/../models/xilinx/cells")
  set(markervp_rtl_cells "${CMAKE_CURRENT_LIST_DIR}/../models/xilinx/cells")
else()
  set(markervp_rtl_cells "${CMAKE_CURRENT_LIST_DIR}/../../../share/markervp/cells")
endif()

# Adds the folders to what Verilator gets. A block memory has a name for each version of the vendor's tools.
function(markervp_rtl_cells FOLDER OPTIONS)
  set(names "")
  foreach(source IN LISTS ARGN)
    file(STRINGS "${source}" lines REGEX "blk_mem_gen_v8[0-9_]*[ \t]*(#|\\()")
    string(REGEX MATCHALL "blk_mem_gen_v8[0-9_]*" found "${lines}")
    list(APPEND names ${found})
  endforeach()
  list(REMOVE_DUPLICATES names)
  foreach(name IN LISTS names)
    file(CONFIGURE OUTPUT "${FOLDER}/${name}.v" @ONLY CONTENT
      "`define MARKERVP_BLK_MEM_GEN @name@\n`include \"blk_mem_gen.vh\"\n`undef MARKERVP_BLK_MEM_GEN\n")
  endforeach()
  set(${OPTIONS} ${${OPTIONS}} -y "${markervp_rtl_cells}" -y "${FOLDER}" PARENT_SCOPE)
endfunction()
