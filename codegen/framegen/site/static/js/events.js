// What a line said, as light as a million of them have to be: what is seldom asked for is worked out
// when it is.
"use strict";

function makeEvent({ fieldsOf, rowsOf }) {
  // A message, an unknown frame or noise: `size` bytes from `at` on the line. Of the last two, `reason`
  // says why they are no message, and `refusedAt` where on the line that showed.
  return class Event {
    constructor(type, at, size, frame, reason, refusedAt, block, start) {
      this.type = type;
      this.at = at;
      this.size = size;
      this.frame = frame;
      this.reason = reason;
      this.refusedAt = refusedAt;
      this.block = block;
      this.start = start;
    }

    // The bytes, as a view of what arrived.
    get bytes() { return this.block.subarray(this.start, this.start + this.size); }

    // The message, as the codec knows it, and its name.
    get kind() { return this.frame && this.frame.kind; }
    get message() { return this.frame && this.frame.kind.name; }

    // Its values by name, as `encode` takes them.
    get fields() { return this.frame && fieldsOf(this.frame, this.bytes); }

    // Its slots with what stands in them.
    get rows() { return this.frame && rowsOf(this.frame, this.bytes); }

    // What JSON says of it.
    toJSON() {
      const { type, at, message, reason, refusedAt, fields } = this, bytes = Array.from(this.bytes);
      return message === null ? { type, at, bytes, reason, refusedAt } : { type, at, bytes, message, fields };
    }
  };
}
