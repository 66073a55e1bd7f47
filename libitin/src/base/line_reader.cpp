#include "base/line_reader.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;

}  // namespace

LineReader::LineReader(std::istream& file, std::string name)
    : name_(std::move(name)), text_(file, name_), buffer_(kBufferBytes) {
  if (!refill()) return;
  const std::string_view start(buffer_.data(), std::min(end_, kLongestLine));
  if (start.find('\n') == std::string_view::npos && start.find('\r') != std::string_view::npos) line_end_ = '\r';
}

/// Moves the unread bytes to the front and reads more behind them; false at the end of the file.
bool LineReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_), buffer_.begin() + static_cast<std::ptrdiff_t>(end_),
            buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  const std::size_t more = text_.read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += more;
  return more > 0;
}

std::optional<std::string_view> LineReader::next() {
  const auto line_end = [&] {
    return static_cast<const char*>(std::memchr(&buffer_[begin_], line_end_, end_ - begin_));
  };
  const char* end = begin_ < end_ ? line_end() : nullptr;
  if (!end && end_ - begin_ <= kLongestLine && refill() && begin_ < end_) end = line_end();
  if (begin_ == end_) return std::nullopt;

  ++line_number_;
  const std::size_t size = end ? static_cast<std::size_t>(end - &buffer_[begin_]) : end_ - begin_;
  if (size > kLongestLine)
    throw InputError(
        fmt::format("{}: line {}: longer than {} bytes; not a text file of rows", name_, line_number_, kLongestLine));
  std::string_view line(&buffer_[begin_], size);
  begin_ += size + (end ? 1 : 0);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace itin
