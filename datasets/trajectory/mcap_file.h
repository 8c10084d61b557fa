#pragma once
/** @file
An MCAP file in the making: messages of several channels by their times, compressed in chunks, with
index, statistics and metadata.

Source: the MCAP format specification, version 0, https://mcap.dev/spec. Compression is zstd
(package libzstd-dev), checksums are CRC-32 (zlib). Not written: attachments. */

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

class McapFile {
 public:
  /** @param library  says who wrote the file. */
  explicit McapFile(const std::string& library);

  /** @param encoding  "protobuf": `data` is a serialised FileDescriptorSet. @returns its id. */
  uint16_t AddSchema(const std::string& name, const std::string& encoding, const std::string& data);
  /** @param encoding  of the messages. @returns its id. */
  uint16_t AddChannel(uint16_t schema, const std::string& topic, const std::string& encoding);
  /** @param time  not before that of the message before [ns]. */
  void AddMessage(uint16_t channel, uint64_t time, std::string_view data);
  void AddMetadata(const std::string& name, const std::map<std::string, std::string>& values);

  /** The file's bytes; to be called once, at the end. */
  std::string Finish();

 private:
  struct MessagePlace {
    uint64_t time, offset;  // in its chunk
  };

  void FinishChunk();

  std::string file_;
  std::string schemas_, channels_;  // their records, for the first chunk and the summary
  uint16_t num_schemas_ = 0, num_channels_ = 0;
  std::string chunk_;  // records of the current one
  uint64_t chunk_start_ = 0, chunk_end_ = 0;
  std::map<uint16_t, std::vector<MessagePlace>> chunk_messages_;
  std::string chunk_indexes_, metadata_indexes_;
  uint32_t num_chunks_ = 0, num_metadata_ = 0, sequence_ = 0;
  uint64_t start_ = 0, end_ = 0;
  std::map<uint16_t, uint64_t> num_messages_;  // by channel
};

}  // namespace graspbench
