// Many numbers in little room: typed arrays that grow by blocks, so that nothing is ever copied.
"use strict";

const COLUMN_BLOCK = 65536;

function makeColumn(Numbers) {
  const blocks = [];
  let size = 0;
  return {
    push(value) {
      if (size % COLUMN_BLOCK === 0) blocks.push(new Numbers(COLUMN_BLOCK));
      blocks[blocks.length - 1][size % COLUMN_BLOCK] = value;
      size++;
    },
    at: (index) => blocks[Math.floor(index / COLUMN_BLOCK)][index % COLUMN_BLOCK],
    get size() {
      return size;
    },
    // The last index whose value is not above this one, where values never fall; -1 if there is none.
    lastUpTo(value) {
      let low = 0, high = size;
      while (low < high) {
        const middle = Math.floor((low + high) / 2);
        if (this.at(middle) <= value) low = middle + 1;
        else high = middle;
      }
      return low - 1;
    },
  };
}

// Bytes that grow at their end, in blocks of 2 to the power of 20.
function makeByteLog() {
  const blocks = [], most = 1 << 20;
  let size = 0;

  function add(bytes) {
    for (let from = 0; from < bytes.length;) {
      const at = size % most, left = bytes.length - from;
      // The first block is small, and grows: most captures are.
      if (at === 0) blocks.push(new Uint8Array(blocks.length ? most : Math.min(most, Math.max(1024, left))));
      const last = blocks.length - 1;
      if (at + left > blocks[last].length && blocks[last].length < most) {
        const wider = new Uint8Array(Math.min(most, 2 * (at + left)));
        wider.set(blocks[last]);
        blocks[last] = wider;
      }
      const piece = bytes.subarray(from, from + blocks[last].length - at);
      blocks[last].set(piece, at);
      from += piece.length;
      size += piece.length;
    }
  }

  // A copy of the bytes from `start` to `end`.
  function slice(start, end) {
    const found = new Uint8Array(Math.max(0, Math.min(end, size) - start));
    for (let at = start; at < start + found.length;) {
      const from = at % most, block = blocks[Math.floor(at / most)];
      const piece = block.subarray(from, Math.min(most, from + start + found.length - at));
      found.set(piece, at - start);
      at += piece.length;
    }
    return found;
  }

  return {
    add, slice,
    get size() {
      return size;
    },
  };
}
