// Reads patterns of antennas.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/lower_case.hpp>
#include <itin/parsed_number.hpp>
#include <profile/diffraction.hpp>

namespace itin::profile {

namespace {

/// What dBi are more than dBd: the gain of a dipole of half a wave.
constexpr double kDipole = 2.15;
/// Antennas that were measured have losses of the other sign by this much, decibels, where they are as good as on their
/// axis.
constexpr double kOtherSign = 1;

std::optional<double> decimal(std::string word) {
  std::replace(word.begin(), word.end(), ',', '.');
  return whole_text_as<double>(word);
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

/// The lines of a file that are not blank, one after the other, as words.
class PatternFile {
 public:
  explicit PatternFile(const std::string& path) : path_(path), text_(path) {
    if (!text_ || std::filesystem::is_directory(path)) throw FileError(path, "cannot be read; check the name");
  }

  bool next() {
    for (std::string line; std::getline(text_, line);) {
      ++line_;
      words_ = words_of(line);
      if (!words_.empty()) return true;
    }
    return false;
  }
  const std::vector<std::string>& words() const { return words_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}", path_, line_, what));
  }
  double number(std::size_t word) const {
    const auto value = word < words_.size() ? decimal(words_[word]) : std::nullopt;
    if (!value) fail(word < words_.size() ? fmt::format("'{}' is no number", words_[word]) : "a number is missing");
    return *value;
  }

 private:
  std::string path_;
  std::ifstream text_;
  std::size_t line_ = 0;
  std::vector<std::string> words_;
};

/// Reads a gain with its unit, which is dBd unless it is stated.
double gain_in(const PatternFile& file) {
  const double gain = file.number(1);
  const std::string unit = file.words().size() > 2 ? in_lower_case(file.words()[2]) : "dbd";
  if (unit != "dbd" && unit != "dbi") file.fail(fmt::format("'{}' is neither dBd nor dBi", file.words()[2]));
  return unit == "dbd" ? gain + kDipole : gain;
}

/// Losses are written without a minus or with one, all alike: gains of both signs would be taken for losses.
void require_one_sign(const PatternFile& file, double least, double greatest) {
  if (least < -kOtherSign && greatest > kOtherSign)
    file.fail(fmt::format("from {:g} to {:g} dB in one cut: give losses from the gain on the axis, not gains", least,
                          greatest));
}

void require_angles_once(const PatternFile& file, const AntennaPattern::Cut& cut) {
  const auto twice = std::adjacent_find(
      cut.begin(), cut.end(), [](const auto& a, const auto& b) { return a.first == b.first && a.second != b.second; });
  if (twice != cut.end()) file.fail(fmt::format("the cut has two losses at {:g} degrees", twice->first));
}

/// Reads the lines of a cut, degrees and loss.
AntennaPattern::Cut cut_in(PatternFile& file) {
  const double count = file.number(1);
  if (count < 1 || count > 36000) file.fail("a cut has 1 to 36000 angles");
  AntennaPattern::Cut cut;
  double least = 0, greatest = 0;
  while (static_cast<double>(cut.size()) < count) {
    if (!file.next()) file.fail(fmt::format("the file ends after {} of {} angles", cut.size(), count));
    if (!decimal(file.words().front()))
      file.fail(fmt::format("'{}' comes after {} of {} angles", file.words().front(), cut.size(), count));
    const double degrees = file.number(0), loss = file.number(1);
    if (degrees < 0 || degrees > 360) file.fail(fmt::format("{:g} degrees is not within 0 to 360", degrees));
    least = std::min(least, loss), greatest = std::max(greatest, loss);
    cut.emplace_back(degrees, std::abs(loss));
  }
  require_one_sign(file, least, greatest);
  std::sort(cut.begin(), cut.end());
  require_angles_once(file, cut);
  if (cut.size() > 1 && cut.back().first == 360) cut.pop_back();
  return cut;
}

/// Reads MSI. The file stands at its first line.
AntennaPattern msi_pattern(PatternFile& file) {
  AntennaPattern pattern;
  do {
    const std::string key = in_lower_case(file.words().front());
    if (key == "gain") pattern.gain_dbi = gain_in(file);
    if (key == "frequency" && file.words().size() > 1) pattern.frequency_mhz = decimal(file.words()[1]);
    if (key == "horizontal") pattern.horizontal = cut_in(file);
    if (key == "vertical") pattern.vertical = cut_in(file);
  } while (file.next());
  if (pattern.horizontal.empty() && pattern.vertical.empty())
    file.fail("the file is no antenna pattern: MSI has HORIZONTAL and VERTICAL, .ant has numbers");
  if (pattern.horizontal.empty() || pattern.vertical.empty())
    file.fail(fmt::format("the pattern has no {} cut", pattern.horizontal.empty() ? "HORIZONTAL" : "VERTICAL"));
  return pattern;
}

std::vector<double> numbers_in(PatternFile& file) {
  std::vector<double> numbers;
  do {
    for (std::size_t word = 0; word < file.words().size(); ++word) numbers.push_back(file.number(word));
  } while (file.next());
  return numbers;
}

/// Reads the numbers of .ant: a degree each from the axis clockwise, then from the zenith down to the nadir, then up
/// behind. What is behind is like what is before where there is no more; a file of one cut has none.
AntennaPattern ant_pattern(PatternFile& file) {
  constexpr std::size_t kCircle = 360, kFront = 181;
  const std::vector<double> numbers = numbers_in(file);
  const std::size_t of_vertical = numbers.size() - std::min(numbers.size(), kCircle);
  if (numbers.size() < kCircle || (of_vertical != 0 && of_vertical != kFront && of_vertical != kCircle))
    file.fail(fmt::format("{} numbers; .ant has 360, 541 or 720", numbers.size()));
  const auto [least, greatest] = std::minmax_element(numbers.begin(), numbers.end());
  require_one_sign(file, *least, *greatest);
  AntennaPattern pattern;
  for (std::size_t i = 0; i < kCircle; ++i) {
    const std::size_t from_zenith = (i + 90) % kCircle;
    const std::size_t given = of_vertical == kFront && from_zenith >= kFront ? kCircle - from_zenith : from_zenith;
    pattern.horizontal.emplace_back(i, std::abs(numbers[i]));
    pattern.vertical.emplace_back(i, of_vertical == 0 ? 0 : std::abs(numbers[kCircle + given]));
  }
  return pattern;
}

}  // namespace

AntennaPattern read_antenna_pattern(const std::string& path) {
  PatternFile file(path);
  if (!file.next()) file.fail("the file is empty");
  AntennaPattern pattern = decimal(file.words().front()) ? ant_pattern(file) : msi_pattern(file);
  pattern.path = path;
  return pattern;
}

}  // namespace itin::profile
