#include <marker/validation/validation.h>

#include <marker/validation/measured.h>

namespace platform::validation {

namespace {

using Result = std::optional<Measurement>;

Result speedup(const Measured& m, const Groups& groups) {
  return mean_ratio(m, groups, frame_ms, frame_ms);
}

/// Mean over the three families of tests, each counted once.
Result speedup_of_families(const Measured& m) {
  double sum = 0;
  for (const Groups& family : {translation_tests, rotation_tests, feature_test}) {
    const Result one = speedup(m, family);
    if (!one) return std::nullopt;
    sum += one->value / 3;
  }
  return Measurement{sum};
}

Result speedup_at(const Result& ps_only, const Result& hybrid) {
  if (!ps_only || !hybrid) return std::nullopt;
  return Measurement{ps_only->value / hybrid->value};
}

Result in_us(Result ms) {
  constexpr double us_per_ms = 1000;
  if (!ms) return ms;
  ms->value *= us_per_ms;
  if (ms->spread) *ms->spread *= us_per_ms;
  return ms;
}

/// Sum of a member over the entries of a module in a list of result.json.
Result module_value(const Run& run, const char* section, const char* module, const char* key) {
  const auto part = run.root.find(section);
  if (part == run.root.end() || !part->contains("modules")) return std::nullopt;
  Result sum;
  for (const auto& entry : part->at("modules")) {
    if (entry.at("name") != module) continue;
    sum = Measurement{(sum ? sum->value : 0) + entry.at(key).get<double>()};
  }
  return sum;
}

Result ps_watts(const Run& run) {
  const auto path = nlohmann::json::json_pointer("/summary/power_w/ps");
  if (!run.root.contains(path)) return std::nullopt;
  return Measurement{run.root.at(path).get<double>()};
}

Result absent(const Measured&) {
  return std::nullopt;
}

std::vector<RowRule> overall_rules() {
  return {
      {"fps.average", Kind::timing, "mean of 1 / frame time, hybrid, 56 images",
       [](const Measured& m) { return mean(m.hybrid, marker_tests, frames_per_second); }},
      {"speedup.all", Kind::timing, "mean of the three families' means", speedup_of_families},
      {"speedup.translation", Kind::timing, "mean of PS-only / hybrid frame time, 19 images",
       [](const Measured& m) { return speedup(m, translation_tests); }},
      {"speedup.rotation", Kind::timing, "mean of PS-only / hybrid frame time, 22 images",
       [](const Measured& m) { return speedup(m, rotation_tests); }},
      {"speedup.features", Kind::timing, "mean of PS-only / hybrid frame time, 15 images",
       [](const Measured& m) { return speedup(m, feature_test); }},
      {"speedup.features.first", Kind::timing, "PS-only / hybrid frame time, 1 square",
       [](const Measured& m) {
         return speedup_at(at_first(m.ps_only, frame_ms), at_first(m.hybrid, frame_ms));
       }},
      {"speedup.features.last", Kind::timing, "PS-only / hybrid frame time, 15 squares",
       [](const Measured& m) {
         return speedup_at(at_last(m.ps_only, frame_ms), at_last(m.hybrid, frame_ms));
       }},
      {"delta.features",
       Kind::timing,
       "mean of PS-only - hybrid frame time, 15 images",
       [](const Measured& m) { return mean_difference(m, feature_test, frame_ms, frame_ms); },
       {"corner.delta", "blob.delta", "threshold.ps"}},
      {"capture.offset", Kind::timing, "stage capture, PS-only",
       [](const Measured& m) { return in_us(mean(m.ps_only, feature_test, ps_capture_ms)); }},
  };
}

std::vector<RowRule> corner_rules() {
  return {
      {"corner.hybrid", Kind::timing, "feature_extraction + receive, mean of 15 images",
       [](const Measured& m) { return in_us(mean(m.hybrid, feature_test, hybrid_corner_ms)); }},
      {"corner.delta", Kind::timing, "corner_detection (PS) - hybrid's, mean of 15 images",
       [](const Measured& m) {
         return mean_difference(m, feature_test, ps_corner_ms, hybrid_corner_ms);
       }},
      {"corner.speedup",
       Kind::timing,
       "corner_detection (PS) / hybrid's, mean of 15 images",
       [](const Measured& m) {
         return mean_ratio(m, feature_test, ps_corner_ms, hybrid_corner_ms);
       },
       {"corner.delta", "corner.hybrid"}},
      {"corner.growth.hybrid", Kind::timing, "feature_extraction + receive, 15 squares / 1",
       [](const Measured& m) { return growth(m.hybrid, hybrid_corner_ms); }},
      {"corner.growth.ps", Kind::timing, "corner_detection (PS), 15 squares / 1",
       [](const Measured& m) { return growth(m.ps_only, ps_corner_ms); }},
  };
}

std::vector<RowRule> blob_rules() {
  return {
      {"blob.hybrid", Kind::timing, "feature_extraction, mean of 15 images",
       [](const Measured& m) { return in_us(mean(m.hybrid, feature_test, hybrid_blob_ms)); }},
      {"blob.delta", Kind::timing, "blob_detection (PS) - hybrid's, mean of 15 images",
       [](const Measured& m) {
         return mean_difference(m, feature_test, ps_blob_ms, hybrid_blob_ms);
       }},
      {"blob.speedup",
       Kind::timing,
       "blob_detection (PS) / hybrid's, mean of 15 images",
       [](const Measured& m) { return mean_ratio(m, feature_test, ps_blob_ms, hybrid_blob_ms); },
       {"blob.delta", "blob.hybrid"}},
      {"blob.growth.hybrid", Kind::timing, "feature_extraction, 15 squares / 1",
       [](const Measured& m) { return growth(m.hybrid, hybrid_blob_ms); }},
      {"blob.growth.ps", Kind::timing, "blob_detection (PS), 15 squares / 1",
       [](const Measured& m) { return growth(m.ps_only, ps_blob_ms); }},
  };
}

std::vector<RowRule> threshold_rules() {
  return {
      {"threshold.ps", Kind::timing, "threshold (PS), mean of 15 images",
       [](const Measured& m) { return mean(m.ps_only, feature_test, ps_threshold_ms); }},
      {"threshold.hybrid", Kind::timing, "feature_extraction, mean of 15 images",
       [](const Measured& m) { return mean(m.hybrid, feature_test, hybrid_threshold_ms); }},
      {"threshold.speedup",
       Kind::timing,
       "threshold (PS) / hybrid's, mean of 15 images",
       [](const Measured& m) {
         return mean_ratio(m, feature_test, ps_threshold_ms, hybrid_threshold_ms);
       },
       {"threshold.ps"}},
      {"threshold.delta",
       Kind::timing,
       "threshold (PS) - hybrid's, mean of 15 images",
       [](const Measured& m) {
         return mean_difference(m, feature_test, ps_threshold_ms, hybrid_threshold_ms);
       },
       {"threshold.ps"}},
  };
}

std::vector<RowRule> identification_rules() {
  return {
      {"identification.hybrid", Kind::timing, "identification, mean of 15 images",
       [](const Measured& m) { return mean(m.hybrid, feature_test, identification_ms); }},
      {"identification.speedup", Kind::timing, "identification PS-only / hybrid, mean of 15 images",
       [](const Measured& m) {
         return mean_ratio(m, feature_test, identification_ms, identification_ms);
       }},
      {"identification.share.hybrid.first", Kind::timing, "identification / frame, 1 square",
       [](const Measured& m) { return at_first(m.hybrid, identification_share); }},
      {"identification.share.hybrid.last", Kind::timing, "identification / frame, 15 squares",
       [](const Measured& m) { return at_last(m.hybrid, identification_share); }},
      {"identification.share.ps.first", Kind::timing, "identification / frame, 1 square",
       [](const Measured& m) { return at_first(m.ps_only, identification_share); }},
      {"identification.share.ps.last", Kind::timing, "identification / frame, 15 squares",
       [](const Measured& m) { return at_last(m.ps_only, identification_share); }},
      {"pose.duration", Kind::timing, "pose, hybrid, mean of 15 images",
       [](const Measured& m) { return in_us(mean(m.hybrid, feature_test, pose_ms)); }},
      {"pose.iterations", Kind::accuracy, "mean of 56 images",
       [](const Measured& m) { return mean_iterations(m.hybrid, marker_tests); }},
      {"jitter.ps", Kind::given, "put in with --repetitions",
       [](const Measured&) { return Result({ps_jitter_us}); }},
      {"jitter.pl", Kind::given, "put in with --repetitions",
       [](const Measured&) { return Result({pl_jitter_us}); }},
  };
}

std::vector<RowRule> hardware_rules() {
  std::vector<RowRule> rules{
      {"fmax.corner", Kind::estimate, "timing, pl.corner_detection",
       [](const Measured& m) {
         return module_value(m.hybrid, "timing", "pl.corner_detection", "fmax_mhz");
       }},
      {"fmax.threshold", Kind::estimate, "timing, pl.global_threshold",
       [](const Measured& m) {
         return module_value(m.hybrid, "timing", "pl.global_threshold", "fmax_mhz");
       }},
      {"fmax.blob", Kind::estimate, "timing, pl.blob_detection",
       [](const Measured& m) {
         return module_value(m.hybrid, "timing", "pl.blob_detection", "fmax_mhz");
       }},
      {"fmax.nms.unpipelined", Kind::estimate, "a part that was not built", absent},
      {"power.blob", Kind::estimate, "power, sum of pl.blob_detection",
       [](const Measured& m) { return module_value(m.hybrid, "power", "pl.blob_detection", "w"); }},
      {"power.cpu", Kind::estimate, "summary.power_w.ps",
       [](const Measured& m) { return ps_watts(m.hybrid); }},
  };
  rules[0].lower_bound = rules[1].lower_bound = true;
  for (RowRule& rule : rules) rule.taken = rule.id != "power.cpu";
  return rules;
}

template <int tenths>
RowRule width_rule() {
  static const std::string metres = std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
  return {"table5.3.width." + metres + "m", Kind::geometry, "projected side",
          [](const Measured& m) { return marker_width_px(m.hybrid, "z" + metres); }};
}

std::vector<RowRule> accuracy_rules() {
  std::vector<RowRule> rules{width_rule<5>(),  width_rule<10>(), width_rule<15>(),
                             width_rule<20>(), width_rule<25>(), width_rule<30>(),
                             width_rule<35>(), width_rule<40>(), width_rule<45>()};
  const auto add = [&](const char* id, const char* how, Result (*measure)(const Measured&)) {
    rules.push_back({id, Kind::accuracy, how, measure});
  };
  add("corner.error.translation", "corner_px on the marker's plane, 10 images",
      [](const Measured& m) {
        return mean_corner_mm(m.hybrid, {"x", "y"});
      });
  add("corner.error.roll", "corner_px on the marker's plane, 12 images",
      [](const Measured& m) { return mean_corner_mm(m.hybrid, {"roll"}); });
  const char *translation = "mean of translation_mm", *rotation = "mean of rotation_deg";
  add("pose.x.translation", translation,
      [](const Measured& m) { return mean_translation_mm(m.hybrid, {"x"}); });
  add("pose.x.rotation", rotation,
      [](const Measured& m) { return mean_rotation_deg(m.hybrid, {"x"}); });
  add("pose.y.translation", translation,
      [](const Measured& m) { return mean_translation_mm(m.hybrid, {"y"}); });
  add("pose.y.rotation", rotation,
      [](const Measured& m) { return mean_rotation_deg(m.hybrid, {"y"}); });
  add("pose.z.translation", translation,
      [](const Measured& m) { return mean_translation_mm(m.hybrid, {"z"}); });
  add("pose.z.rotation", rotation,
      [](const Measured& m) { return mean_rotation_deg(m.hybrid, {"z"}); });
  add("pose.pitch.translation", translation,
      [](const Measured& m) { return mean_translation_mm(m.hybrid, {"pitch"}); });
  add("pose.pitch.rotation", rotation,
      [](const Measured& m) { return mean_rotation_deg(m.hybrid, {"pitch"}); });
  add("pose.yaw.translation", translation,
      [](const Measured& m) { return mean_translation_mm(m.hybrid, {"yaw"}); });
  add("pose.yaw.rotation", rotation,
      [](const Measured& m) { return mean_rotation_deg(m.hybrid, {"yaw"}); });
  add("pose.roll.translation", translation,
      [](const Measured& m) { return mean_translation_mm(m.hybrid, {"roll"}); });
  add("pose.roll.rotation", rotation,
      [](const Measured& m) { return mean_rotation_deg(m.hybrid, {"roll"}); });
  add("pose.all.translation", "mean of translation_mm, 41 images", [](const Measured& m) {
    return mean_translation_mm(m.hybrid, {"x", "y", "z", "pitch", "yaw", "roll"});
  });
  add("pose.all.rotation", "mean of rotation_deg, 41 images", [](const Measured& m) {
    return mean_rotation_deg(m.hybrid, {"x", "y", "z", "pitch", "yaw", "roll"});
  });
  return rules;
}

}  // namespace

const std::vector<RowRule>& row_rules() {
  static const std::vector<RowRule> rules = [] {
    std::vector<RowRule> all;
    for (const auto part : {overall_rules, corner_rules, blob_rules, threshold_rules,
                            identification_rules, hardware_rules, accuracy_rules}) {
      const std::vector<RowRule> some = part();
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }();
  return rules;
}

const RowRule* find_rule(const std::string& id) {
  for (const RowRule& rule : row_rules()) {
    if (rule.id == id) return &rule;
  }
  return nullptr;
}

}  // namespace platform::validation
