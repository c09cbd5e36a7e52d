#include <validation/published.h>

#include <charconv>
#include <set>
#include <sstream>

#include <input/library_folder.h>
#include <vp/error.h>
#include <vp/input_file.h>
#include <vp/text.h>

namespace platform::validation {

namespace {

namespace fs = std::filesystem;

constexpr const char* header = "id,section,system,quantity,unit,value,spread,note";
constexpr std::size_t columns = 8;

class Reader {
 public:
  explicit Reader(const fs::path& file)
      : file_(file), stream_(vp::read_text(file, "published values")) {}

  std::vector<Published> read() {
    if (!next() || line_ != header) refuse(std::string("the first line is not '") + header + "'");
    std::vector<Published> rows;
    std::set<std::string> ids;
    while (next()) {
      if (line_.empty()) continue;
      rows.push_back(row());
      if (!ids.insert(rows.back().id).second) refuse("'" + rows.back().id + "' is there twice");
    }
    return rows;
  }

 private:
  bool next() {
    ++number_;
    return static_cast<bool>(std::getline(stream_, line_));
  }

  Published row() const {
    const std::vector<std::string> cells = vp::split(line_, ',');
    if (cells.size() != columns) {
      refuse("it has " + std::to_string(cells.size()) + " columns, not " + std::to_string(columns));
    }
    Published row{cells[0],        cells[1], cells[2], cells[3], cells[4],
                  value(cells[5]), 0,        {},       cells[7]};
    const std::size_t point = cells[5].find('.');
    if (point != std::string::npos) row.decimals = static_cast<int>(cells[5].size() - point - 1);
    if (!cells[6].empty()) row.spread = value(cells[6]);
    return row;
  }

  double value(const std::string& text) const {
    double result = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, result);
    if (error != std::errc{} || stop != end) refuse("'" + text + "' is not a number");
    return result;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw vp::InputError("published values " + file_.string() + ", line " +
                         std::to_string(number_) + ": " + problem);
  }

  fs::path file_;
  std::istringstream stream_;
  std::string line_;
  int number_ = 0;
};

}  // namespace

fs::path published_file() {
  std::error_code ignored;
  for (const std::string& folder : input::library_folders()) {
    const fs::path file = fs::path(folder) / "published.csv";
    if (fs::exists(file, ignored)) return file;
  }
  throw vp::InputError("no published.csv in " + vp::one_of(input::library_folders()) +
                       ": install markervp completely");
}

std::vector<Published> read_published(const fs::path& file) {
  return Reader(file).read();
}

}  // namespace platform::validation
