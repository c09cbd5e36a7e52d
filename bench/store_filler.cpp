#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <study/kept_result.h>
#include <study/manifest.h>
#include <study/shard.h>
#include <study/shards.h>

/// libsystemc refers to it.
extern "C" int sc_main(int, char**) {
  return 1;
}

namespace {

using namespace platform::study;

/// The figures of a run, moved a little: a hundred of some four hundred, as of points that differ
/// in their clocks.
Json moved(const Json& json, double by, int& left) {
  Json result = json;
  for (auto& value : result) {
    if (value.is_structured()) {
      value = moved(value, by, left);
    } else if (value.is_number_float() && left-- > 0) {
      value = value.get<double>() * by;
    }
  }
  return result;
}

/// A whole result that the folder keeps.
Json kept_result(const Store& store) {
  std::vector<std::string> foreign;
  for (const std::string& key : store.kept_keys(foreign)) {
    KeptResult kept = read_kept(store.kept_path(key));
    if (!kept.outcome.failed) return std::move(kept.result);
  }
  throw std::runtime_error("no point was computed that ran, with --keep-results");
}

void fill(const std::string& folder) {
  const Store store(folder);
  const Manifest manifest = store.read_manifest();
  const Json result = kept_result(store);
  const Shards there(store);
  Shard shard(store, manifest, "bench");
  constexpr int figures = 100;
  for (std::size_t i = 0; i < manifest.points.size(); ++i) {
    const Point& point = manifest.points[i];
    if (there.has(point.key)) continue;
    const double by = 1 + static_cast<double>(i * 7919 % 1'000'003) / 1e6;
    int left = figures;
    const Json other = moved(result, by, left);
    Outcome outcome;
    outcome.metrics = platform::result::metrics_of(other);
    outcome.complaints = complaints_of(other);
    outcome.wall_s = 0.005;
    outcome.cpu_s = 0.004;
    outcome.attempt = 1;
    shard.add(point, outcome);
  }
  store.flush();
}

}  // namespace

/// Gives every point of a sweep's folder that has none a result made from one that was computed, in
/// a shard as the sweep itself writes it.
int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("name the folder of a sweep");
    fill(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}
