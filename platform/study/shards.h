#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <result/metrics.h>
#include <study/outcome.h>
#include <study/point.h>
#include <study/store.h>

namespace platform::study {

/// A point as it was asked for.
struct AskedPoint {
  Setup setup;
  Json program;  ///< Origins::program
};

/// One computation of a point.
struct Computation {
  std::string key;
  Outcome outcome;  ///< but for its metrics
  std::string engine;
  std::string host;
};

/// What all shards of a folder say. Of several results of one point one that ran counts more than
/// one that failed, a later failure more than an earlier one.
class Shards {
  struct File;

 public:
  /// Throws vp::InputError for a shard of another version of the format, and if two results of a
  /// point differ: runs are exact, so one of them is wrong.
  explicit Shards(const Store& store);
  ~Shards();
  Shards(const Shards&) = delete;
  Shards& operator=(const Shards&) = delete;

  /// Reads what was added since. Throws as the constructor does.
  void refresh();
  /// A sentence for each shard that is damaged; its points from there on are not known.
  std::vector<std::string> damages() const;

  /// Bytes of shards that were read together, since points that follow each other mostly lie so.
  /// Who asks for one point after another keeps one, in one thread.
  class Block {
   private:
    friend class Shards;
    struct Piece {
      std::uint64_t offset = 0;
      std::string bytes;
    };
    std::string_view view(const File& file, std::uint64_t offset, std::size_t size);

    std::map<const File*, Piece> pieces_;
  };

  bool has(const std::string& key) const;
  /// How much of an outcome: `facts` is all but the metrics, which take the longest.
  enum class Want { facts, all };
  /// None: the point was not computed.
  std::optional<Outcome> outcome(const std::string& key, Want want, Block& block) const;
  std::optional<Outcome> outcome(const std::string& key) const;
  /// None if the point was not computed.
  result::Metrics metrics(const std::string& key, Block& block) const;
  std::optional<AskedPoint> asked(const std::string& key) const;

  /// Points that another version of the program computed, and that version in words.
  std::uint64_t of_other_versions(const Json& program, std::string& version) const;

  /// Calls visit(computation) for all, shard by shard.
  void visit(const std::function<void(const Computation&)>& visit) const;

 private:
  struct Place {
    std::int64_t date;
    std::uint64_t offset;
    std::uint32_t file;
    std::uint32_t size;
    bool failed;
  };

  void scan(std::uint32_t number);
  void take(std::uint32_t number, std::string_view body, std::uint64_t offset);
  void check_equal(const std::string& key, const Place& known, const Place& added) const;
  std::optional<Outcome> outcome(const std::string& key, const Place& place, Want want,
                                 Block& block) const;

  Store store_;
  std::vector<std::unique_ptr<File>> files_;
  /// By a hash of the key, which the record has whole.
  std::unordered_map<std::size_t, Place> places_;
};

/// Reads results that earlier versions left in points/, and those whose shard was lost, into a
/// shard of this process: of the manifest's points that `shards` does not know. `on_half` gets the
/// name of a file that is not whole, which then counts for nothing. Throws vp::InputError for one
/// that was changed.
void adopt_kept(const Store& store, const Manifest& manifest, Shards& shards, std::size_t first,
                const std::function<void(const std::string& file)>& on_half);

}  // namespace platform::study
