#include "import/source/line_reader.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

LineReader::LineReader(std::string path) : path_(std::move(path)), in_(path_, std::ios::binary), buffer_(kBufferBytes) {
  if (!in_) throw FileError(path_, "cannot be opened for reading");
}

/// Moves the unread bytes to the front and reads more behind them; false at the end of the file.
bool LineReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_), buffer_.begin() + static_cast<std::ptrdiff_t>(end_),
            buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (in_.eof()) return false;
  in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
  if (in_.bad() || (in_.fail() && !in_.eof())) throw FileError(path_, "cannot be read");
  end_ += static_cast<std::size_t>(in_.gcount());
  bytes_read_ += static_cast<std::uint64_t>(in_.gcount());
  return in_.gcount() > 0;
}

std::optional<std::string_view> LineReader::next() {
  const auto line_end = [&] { return static_cast<const char*>(std::memchr(&buffer_[begin_], '\n', end_ - begin_)); };
  const char* end = begin_ < end_ ? line_end() : nullptr;
  if (!end && refill() && begin_ < end_) end = line_end();
  if (begin_ == end_) return std::nullopt;

  ++line_number_;
  const std::size_t size = end ? static_cast<std::size_t>(end - &buffer_[begin_]) : end_ - begin_;
  if (size > kLongestLine)
    throw InputError(
        fmt::format("{}: line {}: longer than {} bytes; not a text file of points", path_, line_number_, kLongestLine));
  std::string_view line(&buffer_[begin_], size);
  begin_ += size + (end ? 1 : 0);
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line_number_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  return line;
}

}  // namespace itin
