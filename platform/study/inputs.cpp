#include <study/inputs.h>

#include <host/digest.h>
#include <host/document.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include <nlohmann/json.hpp>

namespace platform::study {

namespace {

using Json = nlohmann::ordered_json;

/// So many units, whatever the inputs.
std::uint64_t most_units(const InputRequest& request) {
  return request.limit.value_or(std::numeric_limits<std::uint64_t>::max());
}

/// What both kinds of the platform have.
class Units : public facts::InputSource {
 public:
  const std::vector<std::string>& warnings() const override { return nothing_; }
  const std::vector<std::string>& notes() const override { return nothing_; }

 private:
  std::vector<std::string> nothing_;
};

/// Units that bring nothing: one, or as many as --frames or --repeat say.
class NoInput : public Units {
 public:
  explicit NoInput(const InputRequest& request) : left_(request.limit.value_or(request.repeat)) {}

  facts::SharedInput next() override {
    if (left_ == 0) return nullptr;
    --left_;
    return std::make_shared<const facts::UnitInput>();
  }
  /// A program need not take them, and may deliver more.
  std::optional<std::uint64_t> size() const override { return std::nullopt; }

 private:
  std::uint64_t left_;
};

void refuse_names(const InputRequest& request) {
  if (request.names.empty()) return;
  throw vp::InputError("this design takes no input: leave out '" + request.names.front() + "'");
}

const InputKind& no_input() {
  static const InputKind kind = [] {
    InputKind none;
    none.name = "none";
    none.what = "no input";
    none.open = [](const InputRequest& request) -> std::unique_ptr<facts::InputSource> {
      refuse_names(request);
      return std::make_unique<NoInput>(request);
    };
    none.contents = [](const InputRequest& request) {
      refuse_names(request);
      return Json(Json::array());
    };
    return none;
  }();
  return kind;
}

/// A block of a file.
class Block : public facts::UnitInput {
 public:
  Block(std::string block_name, std::vector<std::uint8_t> bytes)
      : UnitInput(std::move(block_name)), bytes_(std::move(bytes)) {}
  const std::vector<std::uint8_t>& bytes() const override { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// The blocks of a file, which is a whole number of them. Throws vp::InputError.
std::uint64_t blocks_in(const std::string& path, std::size_t bytes) {
  const std::uint64_t size = vp::InputFile(path, "samples").size();
  if (bytes != 0 && size != 0 && size % bytes == 0) return size / bytes;
  throw vp::InputError("samples '" + path + "': " + std::to_string(size) +
                       " bytes are no whole number of blocks: the design takes blocks of " +
                       std::to_string(bytes) + " bytes");
}

const std::vector<std::string>& some_files(const InputRequest& request) {
  if (!request.names.empty()) return request.names;
  throw vp::InputError("this design takes blocks of " + std::to_string(request.need.bytes) +
                       " bytes: name a file of samples");
}

/// Files block by block: "samples.bin#12".
class Samples : public Units {
 public:
  explicit Samples(const InputRequest& request) : request_(request), left_(most_units(request)) {
    for (const std::string& path : some_files(request))
      blocks_ += blocks_in(path, request.need.bytes);
  }

  facts::SharedInput next() override {
    if (left_ == 0 || round_ == request_.repeat) return nullptr;
    if (!file_) open();
    std::vector<std::uint8_t> bytes(request_.need.bytes);
    read(bytes);
    --left_;
    ++block_;
    const std::string& path = request_.names[file_index_];
    auto block = std::make_shared<const Block>(
        std::filesystem::path(path).filename().string() + "#" + std::to_string(block_),
        std::move(bytes));
    if (block_ == blocks_of_file_) close();
    return block;
  }

  std::optional<std::uint64_t> size() const override {
    return std::min(blocks_ * request_.repeat, most_units(request_));
  }

 private:
  void open() {
    const std::string& path = request_.names[file_index_];
    file_.emplace(path, "samples");
    blocks_of_file_ = blocks_in(path, request_.need.bytes);
    block_ = 0;
  }

  void read(std::vector<std::uint8_t>& bytes) {
    const auto deadline = vp::InputFile::HostClock::now() + vp::InputFile::patience;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t got =
          file_->read(reinterpret_cast<char*>(bytes.data() + at), bytes.size() - at, deadline);
      if (got == 0)
        throw vp::InputError("samples '" + request_.names[file_index_] +
                             "' became shorter while they were read");
      at += got;
    }
  }

  void close() {
    file_.reset();
    if (++file_index_ < request_.names.size()) return;
    file_index_ = 0;
    ++round_;
  }

  InputRequest request_;
  std::uint64_t left_;
  std::uint64_t blocks_ = 0;  ///< in all files
  std::uint64_t round_ = 0;
  std::size_t file_index_ = 0;
  std::optional<vp::InputFile> file_;
  std::uint64_t block_ = 0, blocks_of_file_ = 0;
};

const InputKind& samples_input() {
  static const InputKind kind = [] {
    InputKind samples;
    samples.name = "samples";
    samples.what = "files of samples, cut into blocks";
    samples.open = [](const InputRequest& request) -> std::unique_ptr<facts::InputSource> {
      return std::make_unique<Samples>(request);
    };
    samples.contents = [](const InputRequest& request) {
      Json json = Json::array();
      for (const std::string& path : some_files(request)) {
        blocks_in(path, request.need.bytes);
        json.push_back({{"name", std::filesystem::path(path).filename().string()},
                        {"file", host::file_hash(path)}});
      }
      return json;
    };
    return samples;
  }();
  return kind;
}

std::vector<const InputKind*>& known_kinds() {
  static std::vector<const InputKind*> kinds{&no_input(), &samples_input()};
  return kinds;
}

}  // namespace

const std::vector<const InputKind*>& input_kinds() {
  return known_kinds();
}

const InputKind& input_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const InputKind* kind : input_kinds()) {
    if (kind->name == name) return *kind;
    names.emplace_back(kind->name);
  }
  throw vp::InputError("this program has no inputs of the kind '" + name + "': it has " +
                       vp::one_of(names));
}

namespace {

const InputSetting* find_setting(const InputKind& kind, const std::string& name) {
  const auto found =
      std::find_if(kind.settings.begin(), kind.settings.end(),
                   [&](const InputSetting& setting) { return name == setting.name; });
  return found == kind.settings.end() ? nullptr : &*found;
}

}  // namespace

bool is_file_setting(const std::string& name) {
  return std::any_of(input_kinds().begin(), input_kinds().end(), [&](const InputKind* kind) {
    const InputSetting* setting = find_setting(*kind, name);
    return setting && setting->is_file;
  });
}

namespace {

/// The kind that takes the request.
const InputKind& checked(const InputRequest& request) {
  const InputKind& kind = input_kind(request.need.kind);
  for (const auto& [name, unused] : request.settings) {
    if (!find_setting(kind, name))
      throw vp::InputError("'" + name + "' does not apply: this design takes " + kind.what);
  }
  return kind;
}

}  // namespace

std::unique_ptr<facts::InputSource> open_inputs(const InputRequest& request) {
  return checked(request).open(request);
}

Json contents_of(const InputRequest& request) {
  const InputKind& kind = checked(request);
  Json contents = kind.contents(request);
  for (const auto& [name, value] : request.settings) {
    if (!find_setting(kind, name)->is_file) contents.push_back({{name, value}});
  }
  return contents;
}

InputKindRegistration::InputKindRegistration(const InputKind& (*describe)()) {
  known_kinds().push_back(&describe());
}

}  // namespace platform::study
