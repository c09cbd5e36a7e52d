#include <marker/detectors/comparison.h>

#include <fmt/format.h>
#include <host/process.h>
#include <marker/detectors/peers.h>
#include <result/console.h>
#include <result/table.h>
#include <vp/text.h>

#include <algorithm>
#include <cmath>

#define MARKERVP_TEXT_OF(name) #name
#define MARKERVP_TEXT(name) MARKERVP_TEXT_OF(name)

namespace platform::detectors {

namespace {

using result::Json;
using Corners = std::array<PixelPoint, 4>;
using Verdict = Judgement::Verdict;

double distance(const PixelPoint& a, const PixelPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

double mean_distance(const Corners& a, const Corners& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += distance(a[i], b[i]);
  return sum / static_cast<double>(a.size());
}

/// A neighbour's corner is a whole side away, and so is one's own after a quarter turn.
bool lies_at(const Corners& seen, const Corners& truth) {
  constexpr double share_of_side = 0.25;
  double side = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    side += distance(truth[i], truth[(i + 1) % truth.size()]) / static_cast<double>(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (distance(seen[i], truth[i]) > share_of_side * side) return false;
  }
  return true;
}

bool may_be(const SeenMarker& seen, const TrueMarker& truth) {
  return seen.id == truth.id && (!truth.corners_px || lies_at(seen.corners_px, *truth.corners_px));
}

Judgement found(const SeenMarker& seen, const TrueMarker& truth) {
  Judgement result{seen.id, Verdict::found, {}, {}, {}};
  if (truth.corners_px) result.corner_px = mean_distance(seen.corners_px, *truth.corners_px);
  if (truth.pose && seen.pose) {
    result.translation_mm = translation_error_mm(*seen.pose, *truth.pose);
    result.rotation_deg = rotation_error_deg(*seen.pose, *truth.pose);
  }
  return result;
}

std::vector<Judgement> judge_by_ids(const std::optional<std::set<int>>& ids,
                                    const std::vector<SeenMarker>& seen) {
  std::vector<Judgement> result;
  for (const SeenMarker& marker : seen) {
    const bool wrong = ids && ids->count(marker.id) == 0;
    result.push_back({marker.id, wrong ? Verdict::wrong : Verdict::unjudged, {}, {}, {}});
  }
  return result;
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::found:
      return "found";
    case Verdict::wrong:
      return "false";
    case Verdict::missed:
      return "missed";
    default:
      return "unjudged";
  }
}

std::vector<Judgement> judge(const ImageTruth& truth, const std::vector<SeenMarker>& seen) {
  if (!truth.markers) return judge_by_ids(truth.ids, seen);
  std::vector<const TrueMarker*> left;
  for (const TrueMarker& marker : *truth.markers) left.push_back(&marker);
  std::vector<Judgement> result;
  for (const SeenMarker& marker : seen) {
    const auto match = std::find_if(left.begin(), left.end(), [&](const TrueMarker* candidate) {
      return may_be(marker, *candidate);
    });
    if (match == left.end()) {
      result.push_back({marker.id, Verdict::wrong, {}, {}, {}});
    } else {
      result.push_back(found(marker, **match));
      left.erase(match);
    }
  }
  for (const TrueMarker* marker : left) result.push_back({marker->id, Verdict::missed, {}, {}, {}});
  return result;
}

Score score(const Comparison& comparison, const Detector& detector) {
  Score result;
  result.markers = 0;
  const auto add = [](facts::Statistic& statistic, const std::optional<double>& value) {
    if (value) statistic.add(*value);
  };
  for (std::size_t i = 0; i < comparison.images.size(); ++i) {
    const ImageTruth& truth = comparison.images[i].truth;
    if (!truth.markers) {
      result.markers.reset();
    } else if (result.markers) {
      *result.markers += truth.markers->size();
    }
    if ((truth.markers || truth.ids) && !result.wrong) result.wrong = 0;
    result.seen += detector.seen[i].size();
    for (const Judgement& marker : judge(truth, detector.seen[i])) {
      if (marker.verdict == Verdict::found) ++result.found;
      if (marker.verdict == Verdict::wrong) ++*result.wrong;
      add(result.corner_px, marker.corner_px);
      add(result.translation_mm, marker.translation_mm);
      add(result.rotation_deg, marker.rotation_deg);
    }
  }
  return result;
}

namespace {

/// A column of the table. Those that are empty for all detectors are left out.
struct Column {
  const char *title, *markdown, *csv;
  int decimals;
  std::optional<double> (*value)(const Detector&, const Score&);
};

std::optional<double> mean_of(const facts::Statistic& statistic) {
  if (statistic.count() == 0) return std::nullopt;
  return statistic.mean();
}

std::optional<double> most_of(const facts::Statistic& statistic) {
  if (statistic.count() == 0) return std::nullopt;
  return statistic.max();
}

std::optional<double> number(const std::optional<std::uint64_t>& count) {
  if (!count) return std::nullopt;
  return static_cast<double>(*count);
}

template <std::optional<double> HardwareFigures::*figure>
std::optional<double> of_hardware(const Detector& detector, const Score&) {
  return detector.hardware ? (*detector.hardware).*figure : std::nullopt;
}

constexpr Column columns[] = {
    {"seen", "seen", "seen", 0,
     [](const Detector&, const Score& s) { return std::optional<double>(s.seen); }},
    {"found", "found", "found", 0,
     [](const Detector&, const Score& s) {
       return s.markers ? std::optional<double>(s.found) : std::nullopt;
     }},
    {"of", "of", "markers", 0, [](const Detector&, const Score& s) { return number(s.markers); }},
    {"false", "false", "false", 0, [](const Detector&, const Score& s) { return number(s.wrong); }},
    {"px", "corner, px", "corner_px", 4,
     [](const Detector&, const Score& s) { return mean_of(s.corner_px); }},
    {"px most", "most, px", "corner_most_px", 4,
     [](const Detector&, const Score& s) { return most_of(s.corner_px); }},
    {"mm", "translation, mm", "translation_mm", 3,
     [](const Detector&, const Score& s) { return mean_of(s.translation_mm); }},
    {"deg", "rotation, °", "rotation_deg", 3,
     [](const Detector&, const Score& s) { return mean_of(s.rotation_deg); }},
    {"FPS", "chip, FPS", "chip_fps", 1, of_hardware<&HardwareFigures::fps>},
    {"ms", "chip, ms", "chip_latency_ms", 3, of_hardware<&HardwareFigures::latency_ms>},
    {"mJ", "chip, mJ", "chip_energy_mj", 2, of_hardware<&HardwareFigures::energy_mj>},
    {"host ms", "host, ms", "host_ms", 2,
     [](const Detector& d, const Score&) { return std::optional<double>(d.host_ms); }}};

/// The cells of each detector, without columns that have no value.
struct Cells {
  explicit Cells(const Comparison& comparison) {
    std::vector<Score> scores;
    for (const Detector& detector : comparison.detectors)
      scores.push_back(score(comparison, detector));
    for (const Column& column : columns) {
      std::vector<std::optional<double>> values;
      for (std::size_t i = 0; i < scores.size(); ++i)
        values.push_back(column.value(comparison.detectors[i], scores[i]));
      if (std::none_of(values.begin(), values.end(), [](const auto& v) { return v.has_value(); }))
        continue;
      shown.push_back(&column);
      values_of.push_back(values);
    }
  }

  std::string text(std::size_t column, std::size_t detector) const {
    const std::optional<double>& value = values_of[column][detector];
    return value ? vp::format_fixed(*value, shown[column]->decimals) : "";
  }

  std::vector<const Column*> shown;
  std::vector<std::vector<std::optional<double>>> values_of;  ///< by column, then detector
};

std::string what_it_is_of(const Comparison& comparison) {
  return result::counted(comparison.images.size(), "image") + ", markers of " +
         comparison.dictionary;
}

std::string csv_number(const std::optional<double>& value) {
  constexpr int places = 6;
  return value ? vp::format_fixed(*value, places) : "";
}

}  // namespace

std::string console_text(const Comparison& comparison) {
  const Cells cells(comparison);
  std::string text = what_it_is_of(comparison) + "\n\n" + fmt::format("{:<16}", "");
  for (const Column* column : cells.shown) text += fmt::format("{:>8}", column->title);
  for (std::size_t d = 0; d < comparison.detectors.size(); ++d) {
    text += fmt::format("\n{:<16}", comparison.detectors[d].name);
    for (std::size_t c = 0; c < cells.shown.size(); ++c)
      text += fmt::format("{:>8}", cells.text(c, d));
  }
  text += "\n\n";
  for (const Detector& detector : comparison.detectors)
    text += fmt::format("{:<16}  {}\n", detector.name, detector.description);
  for (const Comparison::LeftOut& left_out : comparison.left_out)
    text += fmt::format("{:<16}  left out: {}\n", left_out.design, left_out.why);
  return text +
         "\nFPS, ms and mJ are those of the chip, host ms those of this computer: a library's "
         "detection on\none thread, a design's simulation.\n";
}

std::string markdown_text(const Comparison& comparison) {
  const Cells cells(comparison);
  std::string text = "# Detectors on the same images\n\n" + what_it_is_of(comparison) +
                     ". `markervp compare-detectors` made this page.\n\n| |";
  std::string rule = "\n|---|";
  for (const Column* column : cells.shown) {
    text += fmt::format(" {} |", column->markdown);
    rule += "---:|";
  }
  text += rule;
  for (std::size_t d = 0; d < comparison.detectors.size(); ++d) {
    text += fmt::format("\n| `{}` |", comparison.detectors[d].name);
    for (std::size_t c = 0; c < cells.shown.size(); ++c)
      text += fmt::format(" {} |", cells.text(c, d));
  }
  text += "\n\n";
  for (const Detector& detector : comparison.detectors)
    text += fmt::format("* `{}`: {}\n", detector.name, detector.description);
  for (const Comparison::LeftOut& left_out : comparison.left_out)
    text += fmt::format("* `{}` was left out: {}\n", left_out.design, left_out.why);
  return text;
}

std::string scores_csv(const Comparison& comparison) {
  std::vector<std::string> head{"detector"};
  for (const Column& column : columns) head.emplace_back(column.csv);
  std::string text = result::csv_line(head);
  for (const Detector& detector : comparison.detectors) {
    const Score scored = score(comparison, detector);
    std::vector<std::string> row{detector.name};
    for (const Column& column : columns) {
      const std::optional<double> value = column.value(detector, scored);
      row.push_back(column.decimals == 0 && value ? vp::format_fixed(*value, 0)
                                                  : csv_number(value));
    }
    text += result::csv_line(row);
  }
  return text;
}

std::string detections_csv(const Comparison& comparison) {
  std::string text = "detector,image,id,verdict,corner_px,translation_mm,rotation_deg\n";
  for (const Detector& detector : comparison.detectors) {
    for (std::size_t i = 0; i < comparison.images.size(); ++i) {
      const Image& image = comparison.images[i];
      for (const Judgement& marker : judge(image.truth, detector.seen[i])) {
        text +=
            result::csv_line({detector.name, image.name, std::to_string(marker.id),
                              to_string(marker.verdict), csv_number(marker.corner_px),
                              csv_number(marker.translation_mm), csv_number(marker.rotation_deg)});
      }
    }
  }
  return text;
}

Json to_json(const Comparison& comparison) {
  constexpr int places = 6;
  Json json;
  json["schema"] = 1;
  json["dictionary"] = comparison.dictionary;
  json["images"] = Json::array();
  for (const Image& image : comparison.images) json["images"].push_back(image.name);
  json["detectors"] = Json::array();
  for (const Detector& detector : comparison.detectors) {
    const Score scored = score(comparison, detector);
    Json entry;
    entry["name"] = detector.name;
    entry["description"] = detector.description;
    entry["kind"] = detector.hardware ? "design" : "library";
    for (const Column& column : columns) {
      const std::optional<double> value = column.value(detector, scored);
      if (value && column.csv != std::string("host_ms"))
        entry[column.csv] = result::rounded(*value, places);
    }
    json["detectors"].push_back(entry);
    json["host_ms"][detector.name] = result::rounded(detector.host_ms, places);
  }
  json["left_out"] = Json::array();
  for (const Comparison::LeftOut& left_out : comparison.left_out)
    json["left_out"].push_back({{"design", left_out.design}, {"why", left_out.why}});
  return json;
}

std::vector<std::unique_ptr<Peer>> make_peers(const MarkerSet& markers) {
  const auto entry = reinterpret_cast<decltype(&MARKERVP_PEERS_ENTRY)>(
      host::load_plugin(host::library_folders(), "libmarkervp_peers.so",
                        MARKERVP_TEXT(MARKERVP_PEERS_ENTRY), "there is nothing to compare with"));
  return entry()->peers(markers);
}

}  // namespace platform::detectors
