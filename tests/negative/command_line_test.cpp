// Unknown commands, options and values.
#include <boost/test/unit_test.hpp>

#include "command_line.h"

using namespace negative;

BOOST_FIXTURE_TEST_SUITE(command_line, CommandLine)

BOOST_AUTO_TEST_CASE(commands) {
  refuses({}, {"a command is missing", "run", "scenes", "config"});
  refuses({"rum"}, {"unknown command 'rum'", "did you mean 'run'?"});
  refuses({"demo"}, {"unknown command 'demo'", "markervp run demo"});
  refuses({"--trace", "a.vcd"}, {"'--trace'"});
  refuses({""}, {"unknown command ''"});
}

BOOST_AUTO_TEST_CASE(options) {
  run_refuses({"--traec", "a.vcd"}, {"'--traec'", "did you mean '--trace'?"});
  run_refuses({"--quite"}, {"'--quite'", "did you mean '--quiet'?"});
  run_refuses({"-z"}, {"'-z'"});
  run_refuses({"demo", "--frames"}, {"--frames"});
  refuses({"run", "--output"}, {"--output"});
  refuses({"run", "--output", ""}, {"output folder ''"});
  refuses({"config", "demo"}, {"'demo'"});
  refuses({"scenes", "x", "y"}, {"'y'"});
  refuses({"scenes", "rol"}, {"'rol'", "did you mean 'roll'?"});
  refuses({"completion", "tcsh"}, {"tcsh"});
  refuses({"completion"}, {"SHELL"});
}

BOOST_AUTO_TEST_CASE(devices_and_clocks) {
  refuses({"devices", "xc7z02-1"}, {"unknown device 'xc7z02-1'", "did you mean 'xc7z020-1'?"});
  refuses({"devices", "xc7z007s-3"}, {"'xc7z007s-3'", "xc7z007s-1, xc7z007s-2"});
  refuses({"clocks"}, {"WISH"});
  refuses({"clocks", "55"}, {"'55'", "has no unit", "MHz"});
  refuses({"clocks", "-5 MHz"}, {"'-5 MHz'"});
  refuses({"clocks", "55MHz", "--crystal", "1 GHz"}, {"1000.000 MHz", "30 to 60 MHz"});
  refuses({"clocks", "55MHz", "--for", "gpu"}, {"--for", "gpu", "fclk"});
}

BOOST_AUTO_TEST_CASE(values) {
  run_refuses({"demo", "--fit", "stretch"}, {"--fit", "stretch", "crop", "scale"});
  for (const char* number : {"0", "-3", "many", "1.5", "99999999999999999999"}) {
    run_refuses({"demo", "--frames", number}, {"--frames"});
    run_refuses({"demo", "--repeat", number}, {"--repeat"});
  }
  run_refuses({"--design", "thesys"}, {"thesys", "did you mean 'thesis'?"});
  run_refuses({"--fidelity", "tlm2"}, {"fidelity", "tlm2", "clocked"});
  run_refuses({"--trace", "a.vcd", "--trace-level", "all"},
              {"--trace-level", "all", "ports", "registers"});
}

BOOST_AUTO_TEST_CASE(trace_options) {
  run_refuses({"--trace", "wave.fsdb"}, {"wave.fsdb", ".vcd"});
  run_refuses({"--trace", "wave"}, {"wave", ".vcd"});
  run_refuses({"--trace-window", "1ms:2ms"}, {"options of the trace", "--trace"});
  run_refuses({"--trace-filter", "pl.**"}, {"options of the trace", "--trace"});
  run_refuses({"--trace-trigger", "a rises"}, {"options of the trace", "--trace"});
  run_refuses({"--trace-before", "2"}, {"--trace-before", "--trace-trigger"});
  run_refuses({"--trace", "a.vcd", "--trace-trigger", "a +"},
              {"--trace-trigger: 'a +', column 4", "a value is missing"});
  run_refuses({"--trace", "a.vcd", "--trace-trigger", "feature_overflw rises"},
              {"no signal 'feature_overflw'", "feature_overflow"});
  run_refuses({"--trace-clocks"}, {"options of the trace", "--trace"});
  run_refuses({"--trace", "a.vcd", "--trace-window", "5"}, {"--trace-window '5'", "6ms:7ms"});
  run_refuses({"--trace", "a.vcd", "--trace-window", "2ms:1ms"}, {"ends before it begins"});
  run_refuses({"--trace", "a.vcd", "--trace-window", "1px:2px"}, {"1px:2px"});
  run_refuses({"--trace", "a.vcd", "--trace-filter", "pl.corner_detektion.**"},
              {"pl.corner_detektion.**", "corner_detection"});
  run_refuses({"--trace", "a.vcd", "--trace-filter", "pl..width"}, {"pl..width", "empty level"});
}

/// What is right stays right: the refusals above are not refusals of everything.
BOOST_AUTO_TEST_CASE(what_is_right_is_accepted) {
  for (const Words& arguments : {Words{"--help"},
                                 {"run", "--help"},
                                 {"--version"},
                                 {"scenes"},
                                 {"config"},
                                 {"completion", "bash"}}) {
    const kit::Outcome outcome = start(arguments);
    BOOST_TEST(outcome.exit_code == 0);
    BOOST_TEST(outcome.err == "");
    BOOST_TEST(outcome.out.size() > 10u);
  }
  BOOST_TEST(entries().empty(), "only run writes files");
}

BOOST_AUTO_TEST_SUITE_END()
