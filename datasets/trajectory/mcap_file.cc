#include "datasets/trajectory/mcap_file.h"

#include <zlib.h>
#include <zstd.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr char kMagic[] = "\x89MCAP0\r\n";
constexpr size_t kChunkSize = size_t{1} << 20;  // uncompressed, from which on a chunk ends [bytes]
constexpr int kCompressionLevel = 3;

enum class Opcode : uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 11,
  kMetadata = 12,
  kMetadataIndex = 13,
  kSummaryOffset = 14,
  kDataEnd = 15
};

/** Little endian. */
template <class T>
void Put(T value, std::string& to) {
  for (size_t i = 0; i < sizeof(T); ++i) {
    to += static_cast<char>((static_cast<uint64_t>(value) >> (8 * i)) & 255);
  }
}

void PutText(std::string_view text, std::string& to) {
  Put(static_cast<uint32_t>(text.size()), to);
  to += text;
}

void PutRecord(Opcode opcode, std::string_view content, std::string& to) {
  Put(static_cast<uint8_t>(opcode), to);
  Put(static_cast<uint64_t>(content.size()), to);
  to += content;
}

uint32_t CalcCrc(std::string_view bytes) {
  return static_cast<uint32_t>(
      ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string Compress(const std::string& bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kCompressionLevel);
  GRASPBENCH_DEMAND(!ZSTD_isError(size), ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

}  // namespace

McapFile::McapFile(const std::string& library) {
  file_ = kMagic;
  std::string header;
  PutText("", header);  // no profile
  PutText(library, header);
  PutRecord(Opcode::kHeader, header, file_);
}

uint16_t McapFile::AddSchema(const std::string& name, const std::string& encoding,
                             const std::string& data) {
  std::string schema;
  Put(++num_schemas_, schema);
  PutText(name, schema);
  PutText(encoding, schema);
  PutText(data, schema);
  PutRecord(Opcode::kSchema, schema, schemas_);
  return num_schemas_;
}

uint16_t McapFile::AddChannel(uint16_t schema, const std::string& topic,
                              const std::string& encoding) {
  std::string channel;
  Put(++num_channels_, channel);
  Put(schema, channel);
  PutText(topic, channel);
  PutText(encoding, channel);
  PutText("", channel);  // no metadata
  PutRecord(Opcode::kChannel, channel, channels_);
  return num_channels_;
}

void McapFile::AddMessage(uint16_t channel, uint64_t time, std::string_view data) {
  if (chunk_.empty()) {
    if (num_chunks_ == 0) chunk_ = schemas_ + channels_;
    chunk_start_ = time;
  }
  if (sequence_ == 0) start_ = time;
  chunk_end_ = end_ = time;
  chunk_messages_[channel].push_back({time, chunk_.size()});
  ++num_messages_[channel];
  std::string message;
  Put(channel, message);
  Put(sequence_++, message);
  Put(time, message);  // when it was written down
  Put(time, message);  // when it was said
  message += data;
  PutRecord(Opcode::kMessage, message, chunk_);
  if (chunk_.size() >= kChunkSize) FinishChunk();
}

void McapFile::AddMetadata(const std::string& name,
                           const std::map<std::string, std::string>& values) {
  FinishChunk();
  std::string pairs, metadata, index;
  for (const auto& [key, value] : values) {
    PutText(key, pairs);
    PutText(value, pairs);
  }
  PutText(name, metadata);
  PutText(pairs, metadata);
  const uint64_t start = file_.size();
  PutRecord(Opcode::kMetadata, metadata, file_);
  Put(start, index);
  Put(static_cast<uint64_t>(file_.size()) - start, index);
  PutText(name, index);
  PutRecord(Opcode::kMetadataIndex, index, metadata_indexes_);
  ++num_metadata_;
}

void McapFile::FinishChunk() {
  if (chunk_.empty()) return;
  const std::string packed = Compress(chunk_);
  const uint64_t start = file_.size();
  std::string chunk;
  Put(chunk_start_, chunk);
  Put(chunk_end_, chunk);
  Put(static_cast<uint64_t>(chunk_.size()), chunk);
  Put(CalcCrc(chunk_), chunk);
  PutText("zstd", chunk);
  Put(static_cast<uint64_t>(packed.size()), chunk);
  chunk += packed;
  PutRecord(Opcode::kChunk, chunk, file_);
  const uint64_t end = file_.size();
  std::string offsets;
  for (const auto& [channel, places] : chunk_messages_) {
    Put(channel, offsets);
    Put(static_cast<uint64_t>(file_.size()), offsets);
    std::string list, index;
    for (const MessagePlace& place : places) {
      Put(place.time, list);
      Put(place.offset, list);
    }
    Put(channel, index);
    PutText(list, index);
    PutRecord(Opcode::kMessageIndex, index, file_);
  }
  std::string index;
  Put(chunk_start_, index);
  Put(chunk_end_, index);
  Put(start, index);
  Put(end - start, index);
  PutText(offsets, index);
  Put(static_cast<uint64_t>(file_.size()) - end, index);
  PutText("zstd", index);
  Put(static_cast<uint64_t>(packed.size()), index);
  Put(static_cast<uint64_t>(chunk_.size()), index);
  PutRecord(Opcode::kChunkIndex, index, chunk_indexes_);
  ++num_chunks_;
  chunk_.clear();
  chunk_messages_.clear();
}

std::string McapFile::Finish() {
  FinishChunk();
  std::string data_end;
  Put(uint32_t{0}, data_end);  // no checksum of the whole: each chunk has its own
  PutRecord(Opcode::kDataEnd, data_end, file_);

  std::string statistics, counts;
  uint64_t num_messages = 0;
  for (const auto& [channel, count] : num_messages_) {
    Put(channel, counts);
    Put(count, counts);
    num_messages += count;
  }
  Put(num_messages, statistics);
  Put(num_schemas_, statistics);
  Put(static_cast<uint32_t>(num_channels_), statistics);
  Put(uint32_t{0}, statistics);  // attachments
  Put(num_metadata_, statistics);
  Put(num_chunks_, statistics);
  Put(start_, statistics);
  Put(end_, statistics);
  PutText(counts, statistics);
  std::string statistics_record;
  PutRecord(Opcode::kStatistics, statistics, statistics_record);

  const uint64_t summary_start = file_.size();
  std::string summary, summary_offsets;
  const auto add_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    std::string offset;
    Put(static_cast<uint8_t>(opcode), offset);
    Put(summary_start + summary.size(), offset);
    Put(static_cast<uint64_t>(records.size()), offset);
    PutRecord(Opcode::kSummaryOffset, offset, summary_offsets);
    summary += records;
  };
  add_group(Opcode::kSchema, schemas_);
  add_group(Opcode::kChannel, channels_);
  add_group(Opcode::kStatistics, statistics_record);
  add_group(Opcode::kChunkIndex, chunk_indexes_);
  add_group(Opcode::kMetadataIndex, metadata_indexes_);

  // The checksum covers the summary and the footer up to itself.
  std::string footer;
  const uint64_t offsets_start = summary_start + summary.size();
  summary += summary_offsets;
  Put(static_cast<uint8_t>(Opcode::kFooter), footer);
  Put(uint64_t{20}, footer);
  Put(summary_start, footer);
  Put(offsets_start, footer);
  Put(CalcCrc(summary + footer), footer);
  return std::move(file_.append(summary).append(footer).append(kMagic));
}

}  // namespace graspbench
