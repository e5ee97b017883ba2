# Every frame of the protocol as one type, for a like-for-like comparison.
meta:
  id: servo_frames
  title: Bus servo controller frames
  endian: le
types:
  servo:
    seq:
      - id: servo_id
        type: u1
      - id: position
        type: u2
  servo_move:
    seq:
      - id: header
        contents: [0x55, 0x55]
      - id: length
        type: u1
      - id: command
        contents: [0x03]
      - id: count
        type: u1
      - id: time_ms
        type: u2
      - id: targets
        type: servo
        repeat: expr
        repeat-expr: count
  action_group_run:
    doc: Also what the controller reports when the group starts.
    seq:
      - id: header
        contents: [0x55, 0x55, 0x05, 0x06]
      - id: group
        type: u1
      - id: times
        type: u2
  action_group_stop:
    doc: Also what the controller reports when a group was stopped.
    seq:
      - id: header
        contents: [0x55, 0x55, 0x02, 0x07]
  action_group_completed:
    seq:
      - id: header
        contents: [0x55, 0x55, 0x05, 0x08]
      - id: group
        type: u1
      - id: times
        type: u2
  action_group_speed:
    seq:
      - id: header
        contents: [0x55, 0x55, 0x05, 0x0b]
      - id: group
        type: u1
      - id: percent
        type: u2
  battery_voltage_read:
    seq:
      - id: header
        contents: [0x55, 0x55, 0x02, 0x0f]
  battery_voltage:
    seq:
      - id: header
        contents: [0x55, 0x55, 0x04, 0x0f]
      - id: voltage_mv
        type: u2
  servo_unload:
    seq:
      - id: header
        contents: [0x55, 0x55]
      - id: length
        type: u1
      - id: command
        contents: [0x14]
      - id: count
        type: u1
      - id: servo_ids
        type: u1
        repeat: expr
        repeat-expr: count
  servo_positions_read:
    seq:
      - id: header
        contents: [0x55, 0x55]
      - id: length
        type: u1
      - id: command
        contents: [0x15]
      - id: count
        type: u1
      - id: servo_ids
        type: u1
        repeat: expr
        repeat-expr: count
  servo_positions:
    seq:
      - id: header
        contents: [0x55, 0x55]
      - id: length
        type: u1
      - id: command
        contents: [0x15]
      - id: count
        type: u1
      - id: positions
        type: servo
        repeat: expr
        repeat-expr: count
