#include "mdat/mcap/message_value.hpp"

#include <stdexcept>

#include "mdat/mcap/cdr.hpp"

namespace lasso::mdat::mcap {
namespace {

constexpr std::size_t kLongestPadding = 8;  // writers may fill up the end

class ValueReader {
 public:
  ValueReader(const Definition& definition, std::string_view message) : definition_(definition), in_(message) {}

  MessageValue read() {
    if (!in_.ok()) throw std::invalid_argument("no little-endian CDR");
    MessageValue value = object(0);
    if (in_.left() >= kLongestPadding) throw std::invalid_argument("longer than its definition says");
    return value;
  }

 private:
  MessageValue object(std::size_t type) {
    MessageValue value = MessageValue::object();
    const std::vector<Field>& fields = definition_.types[type].fields;
    for (const Field& field : fields) value[field.name] = field_value(field);
    if (fields.empty()) (void)in_.get<std::uint8_t>();  // ROS gives an empty type one byte
    return value;
  }

  MessageValue field_value(const Field& field) {
    if (field.many == Field::Many::kOne) return one(field);
    const auto count = field.many == Field::Many::kFixed ? field.count : in_.get<std::uint32_t>();
    if (count > in_.left()) throw std::invalid_argument("field " + field.name + " ends beyond the message");
    if (field.basic == Basic::kUint8 && field.many == Field::Many::kSequence) {
      const std::string_view bytes = in_.take(count);
      return MessageValue::binary(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
    }
    MessageValue values = MessageValue::array();
    for (std::uint32_t i = 0; i < count; ++i) values.push_back(one(field));
    return values;
  }

  MessageValue one(const Field& field) {
    MessageValue value = field.basic == Basic::kNone ? object(field.type) : basic(field.basic);
    if (!in_.ok()) throw std::invalid_argument("field " + field.name + " ends beyond the message");
    return value;
  }

  MessageValue basic(Basic kind) {
    switch (kind) {
      case Basic::kBool:
        return in_.get<std::uint8_t>() != 0;
      case Basic::kInt8:
        return in_.get<std::int8_t>();
      case Basic::kUint8:
        return in_.get<std::uint8_t>();
      case Basic::kInt16:
        return in_.get<std::int16_t>();
      case Basic::kUint16:
        return in_.get<std::uint16_t>();
      case Basic::kInt32:
        return in_.get<std::int32_t>();
      case Basic::kUint32:
        return in_.get<std::uint32_t>();
      case Basic::kInt64:
        return in_.get<std::int64_t>();
      case Basic::kUint64:
        return in_.get<std::uint64_t>();
      case Basic::kFloat32:
        return in_.get<float>();
      case Basic::kFloat64:
        return in_.get<double>();
      default:
        return std::string(in_.text());
    }
  }

  const Definition& definition_;
  CdrReader in_;
};

class ValueWriter {
 public:
  explicit ValueWriter(const Definition& definition) : definition_(definition) {}

  std::string write(const MessageValue& value) {
    object(0, value);
    return out_.bytes();
  }

 private:
  void object(std::size_t type, const MessageValue& value) {
    const std::vector<Field>& fields = definition_.types[type].fields;
    for (const Field& field : fields) put_field(field, value.at(field.name));
    if (fields.empty()) out_.put(std::uint8_t{0});
  }

  void put_field(const Field& field, const MessageValue& value) {
    if (field.many == Field::Many::kOne) return one(field, value);
    if (value.is_binary()) {
      const auto& bytes = value.get_binary();
      out_.blob({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
      return;
    }
    if (field.many == Field::Many::kSequence) out_.put(static_cast<std::uint32_t>(value.size()));
    for (const MessageValue& element : value) one(field, element);
  }

  void one(const Field& field, const MessageValue& value) {
    if (field.basic == Basic::kNone) return object(field.type, value);
    basic(field.basic, value);
  }

  void basic(Basic kind, const MessageValue& value) {
    switch (kind) {
      case Basic::kBool:
        out_.put(static_cast<std::uint8_t>(value.get<bool>()));
        break;
      case Basic::kInt8:
        out_.put(value.get<std::int8_t>());
        break;
      case Basic::kUint8:
        out_.put(value.get<std::uint8_t>());
        break;
      case Basic::kInt16:
        out_.put(value.get<std::int16_t>());
        break;
      case Basic::kUint16:
        out_.put(value.get<std::uint16_t>());
        break;
      case Basic::kInt32:
        out_.put(value.get<std::int32_t>());
        break;
      case Basic::kUint32:
        out_.put(value.get<std::uint32_t>());
        break;
      case Basic::kInt64:
        out_.put(value.get<std::int64_t>());
        break;
      case Basic::kUint64:
        out_.put(value.get<std::uint64_t>());
        break;
      case Basic::kFloat32:
        out_.put(value.get<float>());
        break;
      case Basic::kFloat64:
        out_.put(value.get<double>());
        break;
      default:
        out_.text(value.get_ref<const std::string&>());
        break;
    }
  }

  const Definition& definition_;
  CdrWriter out_;
};

}  // namespace

MessageValue value_of(const Definition& definition, std::string_view message) { return ValueReader(definition, message).read(); }

std::string message_of(const Definition& definition, const MessageValue& value) { return ValueWriter(definition).write(value); }

}  // namespace lasso::mdat::mcap
