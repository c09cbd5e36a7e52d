// The traces that are kept in the project are those that the examples make now, and their GTKWave
// save files fit them.
#include <boost/test/unit_test.hpp>
#include <fstream>
#include <set>

#include "trace_reader.h"

using appendix_c::TraceOf;

namespace {

const std::filesystem::path folder = MARKERVP_TRACES "/appendix_c";

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What is wrong with a save file: signals that the trace does not have, a marker outside of it,
/// filter files that are missing.
std::vector<std::string> faults(const std::vector<std::string>& save_file, const VcdCheck& vcd) {
  std::vector<std::string> found;
  std::size_t signals = 0;
  for (std::string line : save_file) {
    if (line.empty() || line[0] == '[' || line[0] == '@' || line[0] == '-') continue;
    if (line[0] == '*') {
      const std::uint64_t marker = std::stoull(line.substr(line.find(' ') + 1));
      if (marker < vcd.start_ps() || marker > vcd.end_ps()) found.push_back("marker outside");
      continue;
    }
    if (line[0] == '^') {
      if (!std::filesystem::exists(folder / line.substr(3))) found.push_back("no file " + line);
      continue;
    }
    if (line[0] == '+') line = line.substr(line.find("} ") + 2);
    const std::size_t bracket = line.find('[');
    const auto variable = vcd.variables().find(line.substr(0, bracket));
    ++signals;
    if (variable == vcd.variables().end()) {
      found.push_back("no signal " + line);
    } else if (const unsigned width = variable->second.width;
               (bracket == std::string::npos ? "" : line.substr(bracket)) !=
               (width == 1 ? "" : "[" + std::to_string(width - 1) + ":0]")) {
      found.push_back("width of " + line);
    }
  }
  if (signals == 0) found.push_back("no signals");
  return found;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(kept_traces)

BOOST_AUTO_TEST_CASE(each_is_byte_for_byte_what_its_example_makes) {
  for (const appendix_c::Example& example : appendix_c::examples()) {
    BOOST_TEST_CONTEXT(example.name << ": 'appendix_c_traces traces/appendix_c' makes it anew") {
      const TraceOf made(example.name);
      BOOST_TEST(VcdCheck::text_of((folder / (example.name + ".vcd")).string()) == made.text());
    }
  }
}

BOOST_AUTO_TEST_CASE(two_runs_make_the_same_bytes) {
  for (const appendix_c::Example& example : appendix_c::examples()) {
    BOOST_TEST(TraceOf(example.name).text() == TraceOf(example.name).text(), example.name);
  }
}

BOOST_AUTO_TEST_CASE(each_example_and_nothing_else_is_kept) {
  std::set<std::string> expected, kept;
  for (const appendix_c::Example& example : appendix_c::examples()) {
    expected.insert(example.name + ".vcd");
    expected.insert(example.name + ".gtkw");
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path name = entry.path().filename();
    if (name.extension() == ".vcd" || name.extension() == ".gtkw") kept.insert(name.string());
    BOOST_TEST(entry.file_size() < 100'000u, name.string());
  }
  BOOST_TEST(kept == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(each_save_file_fits_its_trace) {
  for (const appendix_c::Example& example : appendix_c::examples()) {
    BOOST_TEST_CONTEXT(example.name) {
      const TraceOf trace(example.name);
      for (const std::string& fault :
           faults(lines_of(folder / (example.name + ".gtkw")), trace.vcd())) {
        BOOST_ERROR(fault);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_save_file_that_does_not_fit_is_noticed) {
  const TraceOf trace("c02_contiguity");
  const std::vector<std::string> good{"*-10.0 60000 -1", "@28", "contiguity.contiguous", "@24",
                                      "contiguity.bright[15:0]"};
  BOOST_TEST(faults(good, trace.vcd()).empty());
  for (const char* bad : {"contiguity.brigt[15:0]", "contiguity.bright[7:0]", "contiguity.bright",
                          "+{alias} contiguity.nothing", "^1 missing.txt", "*-10.0 999999 -1"}) {
    std::vector<std::string> lines = good;
    lines.push_back(bad);
    BOOST_TEST(faults(lines, trace.vcd()).size() == 1u, bad);
  }
  BOOST_TEST(faults({"@28"}, trace.vcd()).size() == 1u);
}

BOOST_AUTO_TEST_CASE(an_unknown_example_is_refused) {
  BOOST_CHECK_THROW(appendix_c::write_trace("c13", "nowhere.vcd"), std::out_of_range);
}

BOOST_AUTO_TEST_SUITE_END()
