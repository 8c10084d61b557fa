#include "datasets/trajectory/mcap_file.h"

#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

#include <map>

namespace graspbench {
namespace {

/** Reads records as the specification describes them, with its own arithmetic. */
struct Reader {
  std::string_view bytes;
  size_t at = 0;

  uint64_t Number(int size) {
    uint64_t value = 0;
    for (int i = size - 1; i >= 0; --i) {
      value = value * 256 + static_cast<uint8_t>(bytes.at(at + static_cast<size_t>(i)));
    }
    at += static_cast<size_t>(size);
    return value;
  }
  std::string Text(int size_of_length = 4) {
    const size_t length = Number(size_of_length);
    at += length;
    return std::string(bytes.substr(at - length, length));
  }
};

struct Record {
  uint64_t start;
  int opcode;
  std::string content;
};
std::vector<Record> ReadRecords(std::string_view bytes, size_t start, size_t end) {
  Reader reader{bytes.substr(0, end), start};
  std::vector<Record> records;
  while (reader.at < end) {
    const uint64_t from = reader.at;
    const int opcode = static_cast<int>(reader.Number(1));
    records.push_back({from, opcode, reader.Text(8)});
  }
  return records;
}

constexpr std::string_view kFrame = "\x89MCAP0\r\n";

std::string MakeFile(int num_messages, size_t size) {
  McapFile file("test");
  const uint16_t schema = file.AddSchema("a.B", "protobuf", "descriptor");
  const uint16_t first = file.AddChannel(schema, "/first", "protobuf");
  const uint16_t second = file.AddChannel(schema, "/second", "protobuf");
  file.AddMetadata("about", {{"key", "value"}});
  for (int i = 0; i < num_messages; ++i) {
    file.AddMessage(i % 2 ? second : first, 1000u * static_cast<uint64_t>(i),
                    std::string(size, static_cast<char>('a' + i % 26)));
  }
  return file.Finish();
}

TEST(McapFile, HoldsItsMessagesInCompressedChunks) {
  const std::string file = MakeFile(5, 500000);  // two messages and a bit make a chunk
  ASSERT_EQ(file.substr(0, 8), kFrame);
  ASSERT_EQ(file.substr(file.size() - 8), kFrame);
  const std::vector<Record> records = ReadRecords(file, 8, file.size() - 8);
  EXPECT_EQ(records.front().opcode, 1);
  EXPECT_EQ(records.back().opcode, 2);
  int num_messages = 0, num_chunks = 0;
  for (const Record& record : records) {
    if (record.opcode != 6) continue;
    ++num_chunks;
    Reader chunk{record.content};
    chunk.at = 16;
    std::string plain(chunk.Number(8), '\0');
    const uint64_t crc = chunk.Number(4);
    EXPECT_EQ(chunk.Text(), "zstd");
    const std::string packed = chunk.Text(8);
    ASSERT_EQ(ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size()),
              plain.size());
    EXPECT_EQ(crc, crc32(0, reinterpret_cast<const Bytef*>(plain.data()),
                         static_cast<uInt>(plain.size())));
    for (const Record& inner : ReadRecords(plain, 0, plain.size())) {
      if (inner.opcode != 5) continue;
      Reader message{inner.content};
      EXPECT_EQ(message.Number(2), num_messages % 2 ? 2u : 1u);
      EXPECT_EQ(message.Number(4), static_cast<uint64_t>(num_messages));
      EXPECT_EQ(message.Number(8), 1000u * static_cast<uint64_t>(num_messages));
      message.at += 8;
      EXPECT_EQ(inner.content.substr(message.at),
                std::string(500000, static_cast<char>('a' + num_messages)));
      ++num_messages;
    }
  }
  EXPECT_EQ(num_messages, 5);
  EXPECT_EQ(num_chunks, 2);
}

TEST(McapFile, ItsSummaryFindsEverything) {
  const std::string file = MakeFile(5, 500000);
  const std::vector<Record> records = ReadRecords(file, 8, file.size() - 8);
  Reader footer{records.back().content};
  const uint64_t summary = footer.Number(8), offsets = footer.Number(8), crc = footer.Number(4);
  const size_t covered = file.size() - 8 - 4 - summary;
  EXPECT_EQ(crc, crc32(0, reinterpret_cast<const Bytef*>(file.data() + summary),
                       static_cast<uInt>(covered)));
  std::map<uint64_t, int> opcode_at;
  for (const Record& record : records) opcode_at[record.start] = record.opcode;
  int num_indexes = 0;
  for (const Record& record : records) {
    Reader reader{record.content};
    if (record.opcode == 8) {  // of a chunk and of its messages
      reader.at = 16;
      EXPECT_EQ(opcode_at[reader.Number(8)], 6);
      reader.at += 8;
      Reader places{record.content, reader.at};
      const uint64_t end = places.Number(4) + places.at;
      while (places.at < end) {
        places.at += 2;
        EXPECT_EQ(opcode_at[places.Number(8)], 7);
      }
      ++num_indexes;
    } else if (record.opcode == 13) {
      EXPECT_EQ(opcode_at[reader.Number(8)], 12);
      ++num_indexes;
    } else if (record.opcode == 14) {
      EXPECT_GE(record.start, offsets);
      const auto opcode = static_cast<int>(reader.Number(1));
      EXPECT_EQ(opcode_at[reader.Number(8)], opcode);
    } else if (record.opcode == 11) {
      EXPECT_EQ(reader.Number(8), 5u);
      EXPECT_EQ(reader.Number(2), 1u);
      EXPECT_EQ(reader.Number(4), 2u);
    }
  }
  EXPECT_EQ(num_indexes, 3);
}

}  // namespace
}  // namespace graspbench
