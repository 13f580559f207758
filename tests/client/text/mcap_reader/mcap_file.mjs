// SPDX-License-Identifier: BSD-3-Clause
// An MCAP file as the reader of the format's inventors wants it.
import { open } from 'node:fs/promises';
import { McapIndexedReader } from '@mcap/core';
import * as fzstd from 'fzstd';

export const decompressHandlers = { zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))) };

// Chunk by chunk, as the file's index has them.
export async function openIndexed(file) {
  const handle = await open(file);
  const readable = {
    size: async () => BigInt((await handle.stat()).size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      await handle.read(bytes, 0, Number(length), Number(offset));
      return bytes;
    },
  };
  return McapIndexedReader.Initialize({ readable, decompressHandlers });
}
