# Synthesises every IP again, and compares with the figures that are committed.
execute_process(COMMAND "${MARKERVP}" rtl synth --output "${FRESH}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" -E compare_files "${FIGURES}" "${FRESH}" RESULT_VARIABLE differs)
if(differs)
  message(FATAL_ERROR "${FIGURES} is not what Yosys gives: copy ${FRESH} over it, and look at docs/rtl-library.md")
endif()
