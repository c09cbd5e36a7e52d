# VHDL as Verilog, by GHDL, for markervp_add_rtl() (MarkervpRtl.cmake).

# VHDL into one file of Verilog, the generics set.
function(markervp_rtl_from_vhdl NAME TOP FILE GENERICS OPTIONS)
  find_program(GHDL_PROGRAM ghdl)
  if(NOT GHDL_PROGRAM)
    message(FATAL_ERROR "markervp_add_rtl(${NAME}): VHDL needs GHDL; install it with 'apt-get install ghdl'")
  endif()
  list(TRANSFORM GENERICS PREPEND -g)
  foreach(language verilog vhdl)
    execute_process(COMMAND "${GHDL_PROGRAM}" --synth --std=08 --out=${language} ${OPTIONS} ${GENERICS} ${ARGN} -e ${TOP}
      RESULT_VARIABLE result OUTPUT_FILE "${FILE}.${language}" ERROR_VARIABLE errors)
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "${errors}\nmarkervp_add_rtl(${NAME}): GHDL cannot synthesise '${TOP}': mend what it says above, "
        "or give it options (GHDL_OPTIONS -fsynopsys for std_logic_unsigned, -frelaxed for shared variables)")
    endif()
  endforeach()
  file(READ "${FILE}.verilog" text)
  file(READ "${FILE}.vhdl" vhdl)
  markervp_vhdl_escape_keywords(text)
  markervp_vhdl_restore_defaults(${NAME} "${vhdl}" text)
  # Assertions stop in reset like those of SystemVerilog, and say where they are in the VHDL.
  string(REGEX REPLACE "/\\* ([^ ]+) +\\*/\n  always @\\*\n    if \\(!([a-z0-9_]+)\\)\n      \\$fatal\\(1, \"[^\"]*\"\\);"
    "always @* assert (\\2) else $error(\"VHDL assertion at \\1\");" text "${text}")
  # The types of VHDL have seen to widths; GHDL writes initial values and multiplexers with delayed assignments.
  file(WRITE "${FILE}" "/* verilator lint_off WIDTH */\n/* verilator lint_off INITIALDLY */\n/* verilator lint_off COMBDLY */\n${text}")
endfunction()

# GHDL 2.0 leaves `when others` out of the case statements that it writes in Verilog (ghdl#2041): a multiplexer would keep its value. Its
# VHDL has the branch, `with … select net <= … value when others;`, in the same order.
function(markervp_vhdl_restore_defaults NAME VHDL TEXT)
  string(REPLACE ";" "@" vhdl "${VHDL}")
  string(REGEX MATCHALL "select [A-Za-z0-9_\\]+ <=[^@]*@" choices "${vhdl}")
  set(rest "${${TEXT}}")
  set(done "")
  while(TRUE)
    string(FIND "${rest}" "\n    endcase" end)
    if(end EQUAL -1)
      break()
    endif()
    string(SUBSTRING "${rest}" 0 ${end} before)
    string(SUBSTRING "${rest}" ${end} -1 rest)
    string(REGEX REPLACE "^\n    endcase" "" rest "${rest}")
    list(POP_FRONT choices choice)
    string(REGEX MATCH ": ([A-Za-z0-9_]+) <= [^\n]*$" item "${before}")
    set(net "${CMAKE_MATCH_1}")
    if(NOT choice MATCHES "select ${net} <=.*[ \n]([^ \n,]+) when others@$")
      message(FATAL_ERROR "markervp_add_rtl(${NAME}): GHDL's Verilog of '${net}' has a case without its others, and its VHDL no such selection: "
        "translate the VHDL yourself and give the Verilog")
    endif()
    markervp_vhdl_literal(${NAME} "${CMAKE_MATCH_1}" value)
    string(APPEND done "${before}\n      default: ${net} <= ${value};\n    endcase")
  endwhile()
  if(choices)
    message(FATAL_ERROR "markervp_add_rtl(${NAME}): GHDL's Verilog lacks a case that its VHDL has: translate the VHDL yourself and give the Verilog")
  endif()
  set(${TEXT} "${done}${rest}" PARENT_SCOPE)
endfunction()

# A value in GHDL's VHDL as one of Verilog: '0', "0101", "XX", n12_o, wrap_clk.
function(markervp_vhdl_literal NAME VALUE RESULT)
  string(TOLOWER "${VALUE}" value)
  if(value MATCHES "^['\"]([01xzu-]+)['\"]$")
    set(bits "${CMAKE_MATCH_1}")
    string(LENGTH "${bits}" width)
    string(REGEX REPLACE "[u-]" "x" bits "${bits}")
    set(${RESULT} "${width}'b${bits}" PARENT_SCOPE)
  elseif(VALUE MATCHES "^(wrap_)?([A-Za-z][A-Za-z0-9_]*)$")
    set(${RESULT} "\\${CMAKE_MATCH_2} " PARENT_SCOPE)  # escaped, for it may be a keyword
  else()
    message(FATAL_ERROR "markervp_add_rtl(${NAME}): cannot read the value '${VALUE}' of GHDL's VHDL: translate the VHDL yourself and give the Verilog")
  endif()
endfunction()

# A name of VHDL that is a keyword of SystemVerilog becomes an escaped one: `\reg `. A keyword itself is never followed by an operator.
function(markervp_vhdl_escape_keywords TEXT)
  set(text "${${TEXT}}")
  foreach(word always and assign automatic bit break byte cell checker class clocking config const constraint context continue cover
      deassign default design disable do edge endcase endconfig endfunction endmodule endtable endtask enum event expect extends final
      first_match force foreach forever fork genvar global implements import include initial inout input inside instance int integer interface
      join large liblist local localparam logic longint matches medium module nand negedge new nor notif0 null output packed parameter pmos
      posedge primitive priority program property protected pull0 pulldown pullup pure rand randc ref reg release rnmos rtran scalared
      sequence shortint shortreal signed small solve specify specparam static string strong struct super supply0 supply1 table tagged task
      this throughout time timeprecision timeunit tran tri tri0 tri1 triand trior trireg type typedef union unique unsigned uwire var vectored
      virtual void wand weak wildcard wire with within wor)
    string(REGEX REPLACE "([^A-Za-z0-9_\\\\'])${word}( *[;,)=:?&|^+<}]| - |\n *[);])" "\\1\\\\${word} \\2" text "${text}")
  endforeach()
  set(${TEXT} "${text}" PARENT_SCOPE)
endfunction()
