#include <report/result_writer.h>

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>

#include <report/result_json.h>

namespace platform::report {

namespace {

constexpr int indent = 2;
constexpr const char* name = "result.json";
constexpr const char* temporary = "a temporary file";
/// Bytes of a result without its frames, with some to spare.
constexpr std::uint64_t around_frames = 1 << 16;

/// File names may hold any bytes; JSON holds UTF-8 only.
std::string dump(const Json& json, int spaces = -1) {
  return json.dump(spaces, ' ', false, Json::error_handler_t::replace);
}

/// The members of `json` as lines of an object that goes on after them.
std::string opened(const Json& json) {
  std::string text = dump(json, indent);
  text.erase(text.size() - 2);  // the last line feed and brace
  return text + ",\n";
}

/// A file without a name, where the results go: a system's folder for temporary files may be small
/// or slow. Not every file system has such files.
std::FILE* nameless_file(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  return descriptor < 0 ? std::tmpfile() : ::fdopen(descriptor, "w+");
}

}  // namespace

ResultWriter::ResultWriter(host::OutputFolder& folder)
    : folder_(folder),
      file_((std::filesystem::path(folder.path()) / name).string()),
      frames_(nameless_file(folder.path())) {
  if (!frames_) throw vp::OutputError(temporary, errno);
  file_.reserve(around_frames);
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::add(const FrameReport& frame) {
  const std::string text = (summary_.frames() == 0 ? "\n    " : ",\n    ") + dump(to_json(frame));
  file_.reserve(around_frames + bytes_ + text.size());
  if (std::fwrite(text.data(), 1, text.size(), frames_.get()) != text.size() ||
      std::fflush(frames_.get()) != 0) {
    throw vp::OutputError(temporary, errno);
  }
  bytes_ += text.size();
  summary_.add(frame);
}

void ResultWriter::finish(const RunFacts& facts, const Provenance& provenance,
                          const std::vector<std::string>& warnings) {
  Json head;
  head["schema"] = result_schema;
  head["provenance"] = to_json(provenance);
  add_run(head, facts);
  head["configuration"] = Json::object();
  for (const auto& [path, value] : facts.configuration) head["configuration"][path] = value;
  add_end(head, facts, warnings);

  folder_.add(name);
  file_.write(opened(head) + "  \"frames\": [");
  std::rewind(frames_.get());
  std::array<char, 1 << 16> block;
  for (std::uint64_t left = bytes_; left > 0;) {
    const std::size_t size =
        std::fread(block.data(), 1, std::min<std::uint64_t>(left, block.size()), frames_.get());
    if (size == 0) throw vp::OutputError(temporary, errno);
    file_.write({block.data(), size});
    left -= size;
  }
  Json tail;
  add_figures(tail, facts, summary_);
  file_.write(summary_.frames() == 0 ? "],\n" : "\n  ],\n");
  file_.write(dump(tail, indent).substr(2) + "\n");
  file_.commit();
}

}  // namespace platform::report
