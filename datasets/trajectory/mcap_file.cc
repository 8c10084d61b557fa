#include "datasets/trajectory/mcap_file.h"

#include <zlib.h>
#include <zstd.h>

#include <type_traits>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr char kMagic[] = "\x89MCAP0\r\n";
constexpr size_t kChunkSize = size_t{1} << 20;  // uncompressed, from which on a chunk ends [bytes]
constexpr int kCompressionLevel = 3;
constexpr std::string_view kNone = "", kZstd = "zstd";

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

/** Numbers little endian, texts behind their lengths. */
template <class T>
void Put(const T& value, std::string& to) {
  if constexpr (std::is_convertible_v<T, std::string_view>) {
    const std::string_view text = value;
    Put(static_cast<uint32_t>(text.size()), to);
    to += text;
  } else {
    for (size_t i = 0; i < sizeof(T); ++i) {
      to += static_cast<char>((static_cast<uint64_t>(value) >> (8 * i)) & 255);
    }
  }
}

template <class... Values>
std::string Pack(const Values&... values) {
  std::string packed;
  (Put(values, packed), ...);
  return packed;
}

uint64_t SizeOf(std::string_view bytes) { return bytes.size(); }

void PutRecord(Opcode opcode, std::string_view content, std::string& to) {
  Put(opcode, to);
  Put(SizeOf(content), to);
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
  PutRecord(Opcode::kHeader, Pack(kNone, library), file_);  // no profile
}

uint16_t McapFile::AddSchema(const std::string& name, const std::string& encoding,
                             const std::string& data) {
  PutRecord(Opcode::kSchema, Pack(++num_schemas_, name, encoding, data), schemas_);
  return num_schemas_;
}

uint16_t McapFile::AddChannel(uint16_t schema, const std::string& topic,
                              const std::string& encoding) {
  const std::string channel = Pack(++num_channels_, schema, topic, encoding, kNone);  // no metadata
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
  // Two times: when it was written down, and when it was said.
  std::string message = Pack(channel, sequence_++, time, time);
  PutRecord(Opcode::kMessage, message += data, chunk_);
  if (chunk_.size() >= kChunkSize) FinishChunk();
}

void McapFile::AddMetadata(const std::string& name,
                           const std::map<std::string, std::string>& values) {
  FinishChunk();
  std::string pairs;
  for (const auto& [key, value] : values) pairs += Pack(key, value);
  const uint64_t start = file_.size();
  PutRecord(Opcode::kMetadata, Pack(name, pairs), file_);
  const std::string index = Pack(start, SizeOf(file_) - start, name);
  PutRecord(Opcode::kMetadataIndex, index, metadata_indexes_);
  ++num_metadata_;
}

void McapFile::FinishChunk() {
  if (chunk_.empty()) return;
  const std::string packed = Compress(chunk_);
  const uint64_t start = file_.size();
  const std::string head = Pack(chunk_start_, chunk_end_, SizeOf(chunk_), CalcCrc(chunk_), kZstd);
  PutRecord(Opcode::kChunk, head + Pack(SizeOf(packed)) + packed, file_);
  const uint64_t end = file_.size();
  std::string offsets;
  for (const auto& [channel, places] : chunk_messages_) {
    offsets += Pack(channel, SizeOf(file_));
    std::string list;
    for (const MessagePlace& place : places) list += Pack(place.time, place.offset);
    PutRecord(Opcode::kMessageIndex, Pack(channel, list), file_);
  }
  PutRecord(Opcode::kChunkIndex,
            Pack(chunk_start_, chunk_end_, start, end - start, offsets, SizeOf(file_) - end, kZstd,
                 SizeOf(packed), SizeOf(chunk_)),
            chunk_indexes_);
  ++num_chunks_;
  chunk_.clear();
  chunk_messages_.clear();
}

std::string McapFile::Finish() {
  FinishChunk();
  // No checksum of the whole: each chunk has its own.
  PutRecord(Opcode::kDataEnd, Pack(uint32_t{0}), file_);

  std::string counts, statistics;
  uint64_t num_messages = 0;
  for (const auto& [channel, count] : num_messages_) {
    counts += Pack(channel, count);
    num_messages += count;
  }
  constexpr uint32_t kNumAttachments = 0;
  PutRecord(Opcode::kStatistics,
            Pack(num_messages, num_schemas_, uint32_t{num_channels_}, kNumAttachments,
                 num_metadata_, num_chunks_, start_, end_, counts),
            statistics);

  const uint64_t summary_start = file_.size();
  std::string summary, summary_offsets;
  const auto add_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    PutRecord(Opcode::kSummaryOffset, Pack(opcode, summary_start + summary.size(), SizeOf(records)),
              summary_offsets);
    summary += records;
  };
  add_group(Opcode::kSchema, schemas_);
  add_group(Opcode::kChannel, channels_);
  add_group(Opcode::kStatistics, statistics);
  add_group(Opcode::kChunkIndex, chunk_indexes_);
  add_group(Opcode::kMetadataIndex, metadata_indexes_);

  // The checksum covers the summary and the footer up to itself.
  const uint64_t offsets_start = summary_start + summary.size();
  summary += summary_offsets;
  std::string footer = Pack(Opcode::kFooter, uint64_t{20}, summary_start, offsets_start);
  Put(CalcCrc(summary + footer), footer);
  return std::move(file_.append(summary).append(footer).append(kMagic));
}

}  // namespace graspbench
