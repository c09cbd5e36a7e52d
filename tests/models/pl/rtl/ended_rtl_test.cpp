// Verilated RTL that ends itself, and registers without reset.
#include <systemc>

#include <vp/error.h>
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "pipeline.h"
#include "rtl_objects.h"

namespace {

/// What frame_status gets besides: a counter, and what happens when it has counted to 1000.
#define AT_1000(statement)                                                           \
  "logic started;\n  logic [19:0] n;\n  always_ff @(posedge clk) if (rst) n <= '0; " \
  "else begin n <= n + 20'd1; " statement " end"

const Bug endings[] = {
    {"finish", "frame_status", "frame_status.sv", "logic started;",
     AT_1000("if (n == 1000) $finish;"), "$finish ("},
    {"stop", "frame_status", "frame_status.sv", "logic started;", AT_1000("if (n == 1000) $stop;"),
     "$stop ("},
    {"fatal", "frame_status", "frame_status.sv", "logic started;",
     AT_1000("if (n == 1000) $fatal(1, \"too many\");"), "too many ("},
    {"error", "frame_status", "frame_status.sv", "logic started;",
     AT_1000("if (n == 1000) $error(\"too many\");"), "too many ("},
    {"assertion", "frame_status", "frame_status.sv", "logic started;",
     AT_1000("assert (n < 1000) else $error(\"%0d are too many\", n);"), "1000 are too many ("},
    {"last_word", "frame_status", "frame_status.sv", "logic started;",
     AT_1000("") "\n  final assert (n < 1000) else $error(\"too many\");", "too many ("},
    {"ring", "frame_status", "frame_status.sv", "assign busy = started",
     "/* verilator lint_off UNOPTFLAT */\n  logic ring;\n  assign ring = started && !ring;\n"
     "  assign busy = ring || started",
     "did not converge"},
};
// Its words would be random. A name that is constant is looked for when the RTL is built.
const Bug no_memory = {
    "no_memory",
    "frame_status",
    "frame_status.sv",
    "logic started;",
    "logic started;\n  logic [7:0] words[4], word;\n"
    "  string name;\n"
    "  initial begin\n    name = \"missing\";\n"
    "    $readmemh({name, \".hex\"}, words);\n  end\n"
    "  always_ff @(posedge clk) word <= words[word[1:0]];\n"
    "  final $display(\"%d\", word);",
    "$readmem or $fopen: file not found: 'missing.hex'; a name that the RTL puts"};
const Bug no_reset = {"no_reset", "frame_status", "frame_status.sv", "      started <= 1'b0;\n",
                      "",         "busy"};

const RtlObjects& objects() {
  static const RtlObjects built([] {
    std::vector<RtlObjects::Object> list;
    for (const Bug& bug : endings) list.push_back({bug.name, bug.ip, "", &bug});
    list.push_back({no_memory.name, no_memory.ip, "", &no_memory});
    list.push_back({no_reset.name, no_reset.ip, "", &no_reset});
    return list;
  }());
  return built;
}

struct Frame : harness::Pipeline {
  explicit Frame(const std::string& fidelity)
      : Pipeline({}, [&fidelity] {
          std::vector<std::string> settings = harness::frame_size(64, 32);
          settings.push_back("pl.fidelity.frame_status=" + fidelity);
          return settings;
        }()) {
    load(harness::noise(64, 32, 7));
  }
};

/// From the construction of the logic to the end of the simulation.
std::string failure_with(const std::string& fidelity) {
  try {
    Frame frame(fidelity);
    frame.run_frame();
    sc_core::sc_stop();
  } catch (const sc_core::sc_report& report) {
    return report.get_msg();
  } catch (const vp::ProtocolError& error) {
    return error.what();
  }
  return "nothing failed";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(ended_rtl)

BOOST_AUTO_TEST_CASE(each_end_is_told_with_its_place) {
  for (const Bug& bug : endings) {
    for (const char* use : {"", "lockstep:"}) {
      const std::string failure = failure_with(use + objects().file(bug.name));
      BOOST_TEST_CONTEXT(use << bug.name << ": " << failure) {
        BOOST_TEST(contains(failure, "pl.frame_status: RTL '" + objects().file(bug.name) +
                                         "' ended itself behind edge "));
        BOOST_TEST(contains(failure, bug.port));
        BOOST_TEST(contains(failure, "frame_status.sv:"));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_memory_without_its_file_ends_the_run) {
  const std::string failure = failure_with(objects().file(no_memory.name));
  BOOST_TEST(contains(failure, no_memory.port), failure);
}

// In the place of the model nothing shows it.
BOOST_AUTO_TEST_CASE(a_register_without_reset_is_found) {
  const std::string failure = failure_with("lockstep:" + objects().file(no_reset.name));
  BOOST_TEST(contains(failure, "when registers without reset start at 1 instead of 0"), failure);
}

BOOST_AUTO_TEST_SUITE_END()
