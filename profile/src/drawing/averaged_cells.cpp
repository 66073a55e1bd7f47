#include <array>

#include <itin/parallel.hpp>
#include <profile/averaged_cells.hpp>

namespace itin::profile {

namespace {

/// The mean of colours, each weighed by how opaque it is.
class MeanColour {
 public:
  void add(const Rgba& c) {
    ++count_, red_ += std::uint64_t{c.alpha} * c.red, green_ += std::uint64_t{c.alpha} * c.green,
        blue_ += std::uint64_t{c.alpha} * c.blue, alpha_ += c.alpha;
  }
  Rgba colour() const {
    const auto rounded = [](std::uint64_t sum, std::uint64_t of) {
      return static_cast<std::uint8_t>((sum + of / 2) / of);
    };
    if (alpha_ == 0) return kTransparent;
    return {rounded(red_, alpha_), rounded(green_, alpha_), rounded(blue_, alpha_), rounded(alpha_, count_)};
  }

 private:
  std::uint64_t count_ = 0, red_ = 0, green_ = 0, blue_ = 0, alpha_ = 0;
};

}  // namespace

std::vector<Rgba> averaged_cells(std::span<const Rgba> colours, CellCounts from, CellCounts to) {
  std::vector<Rgba> means(to.columns * to.rows);
  parallel_for(to.rows, [&](std::size_t row) {
    for (std::size_t column = 0; column < to.columns; ++column) {
      MeanColour mean;
      for (std::size_t r = row * from.rows / to.rows; r < (row + 1) * from.rows / to.rows; ++r)
        for (std::size_t c = column * from.columns / to.columns; c < (column + 1) * from.columns / to.columns; ++c)
          mean.add(colours[r * from.columns + c]);
      means[row * to.columns + column] = mean.colour();
    }
  });
  return means;
}

}  // namespace itin::profile
