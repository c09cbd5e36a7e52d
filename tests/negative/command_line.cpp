#include "command_line.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <map>

namespace negative {

namespace {

namespace fs = std::filesystem;

/// The bytes of a file; the size alone of one that no test wrote byte by byte.
std::string content(const std::string& file) {
  constexpr std::uintmax_t most_bytes = 1 << 26;
  const std::uintmax_t size = fs::file_size(file);
  return size > most_bytes ? std::to_string(size) : kit::read_file(file);
}

/// Every file and folder below `folder`, with what is in the files.
std::map<std::string, std::string> contents(const std::string& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::error_code ignored;  // of links that lead nowhere
    all[entry.path().string()] =
        entry.is_regular_file(ignored) ? content(entry.path().string()) : "";
  }
  return all;
}

std::string joined(const Words& words) {
  std::string text = "markervp";
  for (const std::string& word : words) text += " '" + word + "'";
  return text;
}

}  // namespace

kit::Outcome CommandLine::start(const Words& arguments) const {
  return kit::run_process(MARKERVP_EXECUTABLE, arguments, path());
}

kit::Outcome CommandLine::shell(const std::string& line) const {
  return kit::run_process("/bin/bash", {"-c", "markervp='" MARKERVP_EXECUTABLE "'; " + line},
                          path());
}

void CommandLine::refuses(const Words& arguments, const Words& parts) const {
  BOOST_TEST_CONTEXT(joined(arguments)) {
    const auto before = contents(path());
    const kit::Outcome outcome = start(arguments);
    BOOST_TEST(outcome.signal == 0);
    BOOST_TEST(outcome.exit_code == 2);
    BOOST_TEST(outcome.out == "");
    check_one_line(outcome.err, parts);
    BOOST_TEST((contents(path()) == before), "files were made, changed or removed");
  }
}

void CommandLine::run_refuses(const Words& arguments, const Words& parts) const {
  Words all{"run"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.insert(all.end(), {"--output", "out"});
  refuses(all, parts);
}

void CommandLine::write_image(const std::string& name) const {
  kit::write_file(*this / name, "P5\n640 480\n255\n" + std::string(640 * 480, '\x80'));
}

void check_one_line(const std::string& text, const Words& parts) {
  BOOST_TEST(text.rfind("markervp: ", 0) == 0u, text);
  BOOST_TEST(std::count(text.begin(), text.end(), '\n') == 1, text);
  BOOST_TEST((!text.empty() && text.back() == '\n'), text);
  for (const std::string& part : parts) {
    BOOST_TEST(contains(text, part), "'" << part << "' is not in: " << text);
  }
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace negative
