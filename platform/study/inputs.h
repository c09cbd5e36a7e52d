#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <facts/unit.h>
#include <nlohmann/json_fwd.hpp>

/// Where the units of a run come from.
namespace platform::study {

/// What the user asks for.
struct InputRequest {
  std::vector<std::string> names;               ///< empty: what is usual
  std::map<std::string, std::string> settings;  ///< by InputSetting::name
  facts::InputNeed need = {};
  std::uint64_t repeat = 1;                 ///< times that the whole list is run
  std::optional<std::uint64_t> limit = {};  ///< units at most
};

/// A setting of inputs: an option of `run`, a key of a sweep's file.
struct InputSetting {
  const char* name;     ///< "camera"
  const char* value;    ///< "FILE", or its choices with bars: "crop|scale"
  const char* meaning;  ///< a phrase
  bool is_file = false;
};

/// Where units come from. The platform has "none" and "samples"; applications register theirs.
struct InputKind {
  const char* name;
  const char* what;  ///< "files of samples"
  std::vector<InputSetting> settings = {};
  /// Looks at all inputs and opens them. Throws vp::InputError for one that is wrong.
  std::unique_ptr<facts::InputSource> (*open)(const InputRequest&);
  /// Name and hash of each input and of its settings: what decides a result. Throws vp::InputError.
  nlohmann::ordered_json (*contents)(const InputRequest&);
  /// Makes inputs that take long, once, for this process and those that it forks; may be null.
  void (*warm_up)(const InputRequest&, std::size_t most_bytes) = nullptr;
  /// The names of all inputs that are no files; may be null.
  std::vector<std::string> (*names)() = nullptr;
  /// A key of a sweep's file whose value, lists by name, becomes inputs; may be null.
  const char* key = nullptr;
  using Lists = std::vector<std::pair<std::string, std::vector<std::string>>>;
  std::vector<std::string> (*expand)(const Lists&) = nullptr;
};

/// Opens what a request asks for. Throws vp::InputError for a kind that this program does not have,
/// a setting that the kind does not know, and what the kind refuses.
std::unique_ptr<facts::InputSource> open_inputs(const InputRequest& request);
/// InputKind::contents with the settings that are no files, which decide a result, too. Throws
/// vp::InputError as open_inputs() does.
nlohmann::ordered_json contents_of(const InputRequest& request);

/// Whether a setting of any kind is a file.
bool is_file_setting(const std::string& name);

/// All kinds: "none", "samples", those of the application.
const std::vector<const InputKind*>& input_kinds();
/// Throws vp::InputError for a name that no kind has.
const InputKind& input_kind(const std::string& name);

/// Adds a kind: an object of an application, before main().
class InputKindRegistration {
 public:
  explicit InputKindRegistration(const InputKind& (*describe)());
};

}  // namespace platform::study
