#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <trace/statistics.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::trace {

namespace {

constexpr int places = 3;

std::string shown(const Table::Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::uint64_t>(&cell)) return std::to_string(*whole);
  return vp::format_fixed(std::get<double>(cell), places);
}

/// To six places, as in result.json.
double rounded(double value) {
  constexpr double scale = 1e6;
  return std::round(value * scale) / scale;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

void append(std::string& line, const std::string& cell, std::size_t width, bool left) {
  const std::string blanks(width - cell.size(), ' ');
  line += left ? cell + blanks : blanks + cell;
}

std::string as_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::size_t width = table.columns[c].size();
    for (const auto& row : table.rows) width = std::max(width, shown(row[c]).size());
    widths.push_back(width);
  }
  const auto is_left = [&](std::size_t c) {
    return std::holds_alternative<std::string>(table.rows.front()[c]);
  };
  std::string text = table.title + "\n";
  const auto add_line = [&](const auto& cell_of) {
    std::string line = "  ";
    for (std::size_t c = 0; c < widths.size(); ++c) {
      if (c > 0) line += "  ";
      append(line, cell_of(c), widths[c], is_left(c));
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  add_line([&](std::size_t c) { return table.columns[c]; });
  for (const auto& row : table.rows) add_line([&](std::size_t c) { return shown(row[c]); });
  return text;
}

}  // namespace

std::string tables_as_text(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) {
    if (table.rows.empty() || table.detail) continue;
    text += (text.empty() ? "" : "\n") + as_text(table);
  }
  return text;
}

std::string tables_as_json(const std::vector<Table>& tables) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Table& table : tables) {
    auto& rows = json[table.name] = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
      nlohmann::ordered_json object;
      for (std::size_t c = 0; c < row.size(); ++c) {
        auto& value = object[table.columns[c]];
        if (const auto* text = std::get_if<std::string>(&row[c])) {
          value = *text;
        } else if (const auto* whole = std::get_if<std::uint64_t>(&row[c])) {
          value = *whole;
        } else {
          value = rounded(std::get<double>(row[c]));
        }
      }
      rows.push_back(std::move(object));
    }
  }
  return json.dump(2) + "\n";
}

std::string tables_as_csv(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) {
    if (table.rows.empty()) continue;
    text += (text.empty() ? "" : "\n") + table.name + "\n" + vp::join(table.columns, ",") + "\n";
    for (const auto& row : table.rows) {
      for (std::size_t c = 0; c < row.size(); ++c) {
        const auto* real = std::get_if<double>(&row[c]);
        text += (c > 0 ? "," : "") + (real ? vp::format_fixed(*real, 6) : quoted(shown(row[c])));
      }
      text += "\n";
    }
  }
  return text;
}

namespace {

struct Collector : Replay::Listener {
  std::vector<std::unique_ptr<Statistic>> all;
  bool instant(std::uint64_t ps) override {
    for (const auto& each : all) each->instant(ps);
    return true;
  }
};

[[noreturn]] void refuse(const TraceFile& file, const Vocabulary& words) {
  constexpr std::size_t shown = 4;
  std::vector<std::string> names = file.paths();
  const std::size_t count = names.size();
  if (names.size() > shown) names.resize(shown);
  throw vp::InputError(
      "trace '" + file.name() +
      "' has nothing that markervp knows: no link (….tvalid and ….tready), no buffer "
      "(" +
      (words.buffers.empty() ? "none is known" : words.buffers.front().count + ", …") +
      "), no interrupt, no ps.cpu.frame or ps.cpu.function; "
      "its " +
      std::to_string(count) + " signals are " + vp::join(names, ", ") +
      (count > shown ? ", …" : "") + "; name them with --map");
}

}  // namespace

std::vector<Table> statistics(TraceFile& file, const Vocabulary& words,
                              const StatisticsOptions& options) {
  Replay replay(file);
  Collector collector;
  collector.all.push_back(frame_statistic(replay, words));
  collector.all.push_back(stage_statistic(replay, words));
  collector.all.push_back(link_statistic(replay, file, options));
  collector.all.push_back(buffer_statistic(replay, words));
  collector.all.push_back(interrupt_statistic(replay, words));
  auto& all = collector.all;
  all.erase(std::remove_if(all.begin(), all.end(), [](const auto& s) { return !s->found(); }),
            all.end());
  if (all.empty()) refuse(file, words);
  replay.run(collector);
  std::vector<Table> tables;
  for (const auto& each : all) {
    each->finish(replay.last_ps());
    each->report(tables);
  }
  return tables;
}

}  // namespace platform::trace
