# Frames with checksums, one of each protocol that is measured. What a checksum covers is a stretch
# of its own, so that its bytes are kept; Kaitai Struct itself works no checksum out.
meta:
  id: checksummed_frames
  title: Frames with checksums
  endian: le
types:
  move:
    seq:
      - id: header
        contents: [0x55, 0x55]
      - id: covered
        type: move_covered
        size: 7
      - id: checksum
        type: u1
  move_covered:
    seq:
      - id: servo_id
        type: u1
      - id: length
        contents: [0x07]
      - id: command
        type: u1
      - id: position
        type: u2
      - id: time_ms
        type: u2
  status:
    seq:
      - id: header
        contents: [0xff, 0xff]
      - id: covered
        type: status_covered
        size: 7
      - id: checksum
        type: u1
  status_covered:
    seq:
      - id: servo_id
        type: u1
      - id: length
        type: u1
      - id: error
        type: u1
      - id: data
        type: u1
        repeat: expr
        repeat-expr: length - 2
  acknowledged:
    seq:
      - id: header
        contents: [0xb5, 0x62]
      - id: covered
        type: acknowledged_covered
        size: 6
      - id: checksum
        type: u2
  acknowledged_covered:
    seq:
      - id: ids
        contents: [0x05, 0x01, 0x02, 0x00]
      - id: message_class
        type: u1
      - id: message_id
        type: u1
  question:
    seq:
      - id: covered
        type: question_covered
        size: 6
      - id: checksum
        type: u2
  question_covered:
    seq:
      - id: unit
        type: u1
      - id: function
        contents: [0x03]
      - id: start
        type: u2be
      - id: quantity
        type: u2be
  registers:
    seq:
      - id: covered
        type: registers_covered
        size: 9
      - id: checksum
        type: u2
  registers_covered:
    seq:
      - id: unit
        type: u1
      - id: function
        contents: [0x03]
      - id: size
        type: u1
      - id: registers
        type: u2be
        repeat: expr
        repeat-expr: size / 2
