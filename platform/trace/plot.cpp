#include <trace/tools.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <trace/replay.h>
#include <vp/frame_gate.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform::trace {

namespace {

using Kind = vp::WaveVariable::Kind;

constexpr int row_height = 30, wave_height = 18, top = 34, character = 7;

/// What a signal shows from one change to the next.
struct Piece {
  double x;
  std::string text;
  std::string digits;  ///< as the trace has them
  bool known;
  double number;
  bool busy = false;                     ///< several changes within a pixel
  double least = number, most = number;  ///< within it
};

struct Row {
  std::string name;
  Replay::Slot slot;
  Kind kind;
  unsigned width;
  bool is_event;
  std::vector<Piece> pieces;
};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return result;
}

std::string px(double value) {
  return vp::format_fixed(value, 1);
}

class Plotter final : public Replay::Listener {
 public:
  Plotter(TraceFile& file, const PlotOptions& options) : options_(options), replay_(file) {
    replay_.keep_texts();
    std::size_t longest = 0;
    for (const std::string& name : options.signals) {
      const auto place = vp::find_path(name, file.paths(), "plot: ");
      const vp::WaveVariable& variable = file.variable(place);
      rows_.push_back({file.paths()[place],
                       replay_.watch(place),
                       variable.kind,
                       variable.width,
                       variable.is_event,
                       {}});
      longest = std::max(longest, rows_.back().name.size());
    }
    left_ = 16 + static_cast<double>(longest) * character;
    scale_ = (options.width - left_ - 12) /
             static_cast<double>(std::max<std::uint64_t>(options.to_ps - options.from_ps, 1));
    for (Row& row : rows_) {
      if (row.is_event) row.pieces.push_back({left_, "0", "0", true, 0});
    }
  }

  std::string svg() {
    replay_.run(*this);
    end_ps_ = std::min(options_.to_ps, std::max(replay_.last_ps(), options_.from_ps));
    const double height = top + static_cast<double>(rows_.size()) * row_height + 8;
    std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                       std::to_string(options_.width) + "\" height=\"" + px(height) +
                       "\" font-family=\"DejaVu Sans Mono, monospace\" font-size=\"11\">\n"
                       "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    text += axis(height);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      text += row(rows_[i], top + static_cast<double>(i) * row_height + 6);
    }
    if (options_.marker_ps) {
      const double x = place(*options_.marker_ps);
      text += "<path d=\"M" + px(x) + " " + std::to_string(top - 8) + "V" + px(height - 4) +
              "\" stroke=\"#d55e00\" stroke-width=\"1.5\"/>\n";
    }
    return text + "</svg>\n";
  }

 private:
  bool instant(std::uint64_t ps) override {
    if (ps >= options_.to_ps) return false;
    for (Row& row : rows_) {
      const auto& changed = replay_.changed();
      if (std::find(changed.begin(), changed.end(), row.slot) == changed.end()) continue;
      if (row.is_event) {
        add_event(row, ps);
      } else {
        add(row, ps);
      }
    }
    return true;
  }
  double place(std::uint64_t ps) const {
    const std::uint64_t inside = std::max(ps, options_.from_ps) - options_.from_ps;
    return left_ + static_cast<double>(inside) * scale_;
  }
  void add(Row& row, std::uint64_t ps) {
    const auto number = replay_.now(row.slot);
    Piece piece{place(ps), readable(replay_.text(row.slot), row.kind, row.width),
                replay_.text(row.slot), replay_.known(row.slot),
                static_cast<double>(number.number)};
    if (ps <= options_.from_ps) row.pieces.clear();  // stood before the window
    if (!row.pieces.empty() && piece.x - row.pieces.back().x < 1) {
      const Piece& last = row.pieces.back();
      piece.x = last.x;
      piece.busy = true;
      // A pulse within a pixel is a spike.
      piece.least = std::min(piece.number, last.least);
      piece.most = std::max(piece.number, last.most);
      row.pieces.back() = piece;
    } else {
      row.pieces.push_back(piece);
    }
  }

  /// An event is a spike on a line at 0.
  void add_event(Row& row, std::uint64_t ps) {
    if (ps < options_.from_ps || replay_.bits(row.slot) == 0) return;
    row.pieces.push_back({place(ps), "0", "0", true, 0, true, 0, 1});
    row.pieces.push_back({place(ps), "0", "0", true, 0});
  }

  std::string axis(double height) const {
    const double span = static_cast<double>(options_.to_ps - options_.from_ps);
    double step = std::pow(10, std::floor(std::log10(span / 5)));
    if (span / step > 25) step *= 5;
    if (span / step > 12) step *= 2;
    std::string text;
    double labelled = 0;  // up to there
    const auto whole_step = std::max<std::uint64_t>(static_cast<std::uint64_t>(step), 1);
    const std::uint64_t first = (options_.from_ps + whole_step - 1) / whole_step * whole_step;
    for (std::uint64_t ps = first; ps <= options_.to_ps; ps += whole_step) {
      const double x = place(ps);
      const std::string time = vp::format_time(ps);
      const double width = static_cast<double>(time.size()) * character;
      // The last label stays within the picture, and beside the one before it.
      const bool at_the_end = x + width / 2 > options_.width;
      const double from = at_the_end ? options_.width - 2.0 - width : x - width / 2;
      text += "<path d=\"M" + px(x) + " 22V" + px(height - 4) + "\" stroke=\"#dddddd\"/>";
      if (from > labelled) {
        text += "<text x=\"" + px(at_the_end ? options_.width - 2.0 : x) +
                "\" y=\"16\" text-anchor=\"" + (at_the_end ? "end" : "middle") +
                "\" fill=\"#555555\">" + time + "</text>";
        labelled = from + width + 2;
      }
      text += "\n";
    }
    return text;
  }

  std::string row(const Row& row, double y) const {
    std::string text = "<text x=\"8\" y=\"" + px(y + 13) + "\" fill=\"#111111\">" +
                       escaped(row.name) + "</text>\n";
    const double end = place(end_ps_);
    double least = 0, most = 0;
    for (const Piece& piece : row.pieces) {
      least = std::min(least, piece.number);
      most = std::max(most, piece.number);
    }
    double before = y + wave_height;
    for (std::size_t i = 0; i < row.pieces.size(); ++i) {
      const Piece& piece = row.pieces[i];
      const double to = i + 1 < row.pieces.size() ? row.pieces[i + 1].x : end;
      if (row.kind == Kind::real || (row.kind == Kind::bits && row.width == 1)) {
        const double range = row.kind == Kind::real ? std::max(most - least, 1e-12) : 1;
        const auto height_of = [&](double number) {
          return y + wave_height * (1 - (number - least) / range);
        };
        const double level = height_of(piece.number);
        text +=
            piece.known ? line(piece, before, level, to) : unknown(piece.digits, piece.x, to, y);
        if (piece.busy && piece.least < piece.most)
          text += spike(piece.x, height_of(piece.least), height_of(piece.most));
        before = level;
      } else {
        text += box(row, piece, to, y);
      }
    }
    if (row.kind == Kind::real && !row.pieces.empty()) text += scale(least, most, y);
    return text;
  }
  /// What the top and the bottom of a curve are.
  std::string scale(double least, double most, double y) const {
    const auto label = [&](double value, double below) {
      char number[32];
      std::snprintf(number, sizeof number, "%.6g", value);
      return "<text x=\"" + px(left_ + 2) + "\" y=\"" + px(below) +
             "\" font-size=\"8\" fill=\"#555555\">" + number + "</text>\n";
    };
    return label(most, y + 6) + label(least, y + wave_height - 1.0);
  }
  static std::string line(const Piece& piece, double before, double level, double to) {
    const std::string width = piece.busy ? "2.5" : "1.4";
    return "<path d=\"M" + px(piece.x) + " " + px(before) + "V" + px(level) + "H" + px(to) +
           "\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"" + width + "\"/>\n";
  }
  static std::string spike(double x, double from, double to) {
    return "<path d=\"M" + px(x) + " " + px(from) + "V" + px(to) +
           "\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.4\"/>\n";
  }
  /// An undriven line lies in the middle, one that was never set is grey; all else is x.
  static std::string unknown(const std::string& value, double from, double to, double y) {
    const bool all_z = !value.empty() && value.find_first_not_of('z') == std::string::npos;
    const bool all_u = !value.empty() && value.find_first_not_of('u') == std::string::npos;
    if (all_z) {
      return "<path d=\"M" + px(from) + " " + px(y + wave_height / 2.0) + "H" +
             px(std::max(to, from + 1)) +
             "\" fill=\"none\" stroke=\"#b07d00\" stroke-width=\"1.4\"/>\n";
    }
    if (all_u) {
      return "<rect x=\"" + px(from) + "\" y=\"" + px(y) + "\" width=\"" +
             px(std::max(to - from, 1.0)) + "\" height=\"" + std::to_string(wave_height) +
             "\" fill=\"#e4e4e4\" stroke=\"#777777\"/>\n";
    }
    return "<rect x=\"" + px(from) + "\" y=\"" + px(y) + "\" width=\"" +
           px(std::max(to - from, 1.0)) + "\" height=\"" + std::to_string(wave_height) +
           "\" fill=\"#f3d4c4\" stroke=\"#d55e00\"/>\n";
  }
  static std::string box(const Row& row, const Piece& piece, double to, double y) {
    if (!piece.known) return unknown(piece.digits, piece.x, to, y);
    const double width = to - piece.x;
    const bool quiet = row.kind == Kind::text && piece.text.empty();
    std::string text = "<rect x=\"" + px(piece.x) + "\" y=\"" +
                       px(quiet ? y + wave_height / 2.0 : y) + "\" width=\"" +
                       px(std::max(width, 1.0)) + "\" height=\"" +
                       (quiet ? "1" : std::to_string(wave_height)) + "\" fill=\"" +
                       (piece.busy ? "#9cc7e0" : "#eaf4fa") + "\" stroke=\"#0072b2\"/>\n";
    const auto room = static_cast<std::size_t>(std::max(width - 6, 0.0)) / character;
    if (quiet || room == 0) return text;
    std::string shown = piece.text;
    if (shown.size() > room) {
      if (room < 4) return text;
      shown = shown.substr(0, room - 1) + "…";
    }
    return text + "<text x=\"" + px(piece.x + 4) + "\" y=\"" + px(y + 13) + "\" fill=\"#111111\">" +
           escaped(shown) + "</text>\n";
  }

  const PlotOptions& options_;
  Replay replay_;
  std::vector<Row> rows_;
  double left_ = 0, scale_ = 1;
  std::uint64_t end_ps_ = 0;
};

}  // namespace

std::string plot_as_svg(TraceFile& file, const PlotOptions& options) {
  return Plotter(file, options).svg();
}

std::string readable(const std::string& text, Kind kind, unsigned width) {
  if (kind != Kind::bits || width == 1) return text;
  const std::string padded = vp::full_digits(text, std::max<unsigned>(width + 3, 4) / 4 * 4);
  std::string result;
  for (std::size_t i = 0; i < padded.size(); i += 4) {
    const std::string_view digits = std::string_view(padded).substr(i, 4);
    unsigned value = 0;
    bool known = true;
    for (const char c : digits) {
      known = known && (c == '0' || c == '1' || c == 'l' || c == 'h');
      value = value * 2 + (c == '1' || c == 'h' ? 1 : 0);
    }
    if (!known) {
      const bool alike = digits.find_first_not_of(digits.front()) == std::string_view::npos;
      result += alike ? digits.front() : 'x';
    } else if (value != 0 || !result.empty() || i + 4 == padded.size()) {
      result += "0123456789ABCDEF"[value];
    }
  }
  // All of it is one letter: x, z, u.
  const bool is_letter = std::string_view("xzuw-").find(result.front()) != std::string_view::npos;
  if (is_letter && result.find_first_not_of(result.front()) == std::string::npos) result.resize(1);
  return result;
}

std::string shown_value(const TraceFile& file, const vp::WaveVariable& variable,
                        const std::string& text, Kind kind) {
  if (kind != Kind::bits || (variable.width == 1 && variable.enumeration == 0))
    return text.empty() && kind != Kind::text ? "x" : text;
  if (variable.enumeration != 0) {
    const std::string digits = vp::full_digits(text, variable.width);
    for (const auto& [value, word] : file.reader().enumerations()[variable.enumeration - 1].words) {
      if (vp::full_digits(value, variable.width) == digits) return word;
    }
  }
  if (variable.width == 1) return text.empty() ? "x" : text;
  return "0x" + (text.empty() ? "x" : readable(text, kind, variable.width));
}

}  // namespace platform::trace
