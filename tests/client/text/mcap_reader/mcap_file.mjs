// SPDX-License-Identifier: BSD-3-Clause
// Opens an MCAP file for the format's reference reader.
import { open } from 'node:fs/promises';
import { McapIndexedReader } from '@mcap/core';
import * as fzstd from 'fzstd';

export const decompressHandlers = { zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))) };

// Reads chunk by chunk, in the order of the file's index.
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
