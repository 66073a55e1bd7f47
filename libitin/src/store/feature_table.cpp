#include "store/feature_table.hpp"

#include <bit>
#include <iterator>

#include "store/codec/zstd_frame.hpp"
#include "store/segments/content_stream.hpp"
#include "store/store_file.hpp"

namespace itin {

namespace {

/// The most bytes that a block of features may hold.
constexpr std::size_t kMostFeatureBytes = kFeaturesInBlock * (kMostAttributes + 2) * (kLongestText + 10);

enum ValueType : std::uint8_t { kNoValue, kNumberValue, kWholeValue, kTextValue };

void write_value(ContentWriter& out, const AttributeValue& value) {
  out.whole(value.index());
  if (const auto* number = std::get_if<double>(&value)) out.number(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) out.word(std::bit_cast<std::uint64_t>(*whole));
  if (const auto* text = std::get_if<std::string>(&value)) out.text(*text);
}

AttributeValue read_value(ContentReader& in) {
  switch (in.whole(kTextValue)) {
    case kNumberValue:
      return in.number();
    case kWholeValue:
      return std::bit_cast<std::int64_t>(in.word());
    case kTextValue:
      return in.text();
    default:
      return {};
  }
}

}  // namespace

const FeatureRecord* FeatureTable::at(std::int64_t number) {
  const auto block = static_cast<std::uint64_t>(number) / kFeaturesInBlock;
  if (number < 0 || block >= store_.metadata().themes[theme_ - std::size_t{1}].feature_blocks) return nullptr;
  const auto key = static_cast<std::uint32_t>(block);
  auto found = blocks_.find(key);
  if (found == blocks_.end()) found = blocks_.emplace(key, file_of(store_).read_features(theme_, key)).first;
  const std::size_t place = static_cast<std::size_t>(number) % kFeaturesInBlock;
  return place < found->second.size() ? &found->second[place] : nullptr;
}

ThemeFeatures stored_features(const Store& store, std::uint16_t theme) {
  const ThemeInfo& info = store.metadata().themes[theme - std::size_t{1}];
  ThemeFeatures all{info.fields, {}};
  for (std::uint32_t i = 0; i < info.feature_blocks; ++i) {
    std::vector<FeatureRecord> some = file_of(store).read_features(theme, i);
    std::move(some.begin(), some.end(), std::back_inserter(all.records));
  }
  return all;
}

std::vector<std::uint8_t> encode_features(std::span<const FeatureRecord> records) {
  ContentWriter out;
  for (const FeatureRecord& record : records) {
    out.text(record.id);
    out.text(record.name);
    out.whole(record.values.size());
    for (const AttributeValue& value : record.values) write_value(out, value);
  }
  return compress(out.bytes());
}

std::vector<FeatureRecord> decode_features(std::span<const std::uint8_t> bytes, std::size_t fields) {
  const std::vector<std::uint8_t> content = decompress(bytes, kMostFeatureBytes);
  ContentReader in(content);
  std::vector<FeatureRecord> records;
  while (!in.at_end()) {
    FeatureRecord& record = records.emplace_back();
    record.id = in.text();
    record.name = in.text();
    record.values.resize(static_cast<std::size_t>(in.whole(fields)));
    for (AttributeValue& value : record.values) value = read_value(in);
  }
  if (records.empty() || records.size() > kFeaturesInBlock) throw DecodeError("has the wrong number of features");
  return records;
}

}  // namespace itin
