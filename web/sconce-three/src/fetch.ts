// SPDX-License-Identifier: Apache-2.0
// Files of a site over a network that may fail.

const kTries = 3;

/** Told how many bytes more have arrived; negative when a try was in vain. */
export type Arrived = (bytes: number) => void;

/** @throws Error in words for people, naming the file */
async function open(url: string, signal?: AbortSignal): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(url, { signal: signal ?? null });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Error(`${url} cannot be reached`);
  }
  if (!response.ok) throw new Error(`${url} is missing (${response.status})`);
  return response;
}

export async function fetchText(url: string, signal?: AbortSignal): Promise<string> {
  return (await open(url, signal)).text();
}

export async function fetchBlob(url: string, signal?: AbortSignal): Promise<Blob> {
  return (await open(url, signal)).blob();
}

/** Undoes pack() of src/web/packed.cpp. @param element bytes of one */
export function unpack(sorted: Uint8Array, element: number): Uint8Array<ArrayBuffer> {
  const count = sorted.length / element;
  const out = new Uint8Array(sorted.length);
  for (let k = 0, from = 0; k < element; ++k) {
    let byte = 0;
    for (let i = k; i < out.length; i += element) out[i] = byte = (byte + sorted[from++]!) & 255;
  }
  if (!Number.isInteger(count)) throw new Error('is damaged');
  return out;
}

async function tryPacked(url: string, element: number, arrived: Arrived, signal?: AbortSignal) {
  const response = await open(url, signal);
  let count = 0;
  const counter = new TransformStream<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>({
    transform(chunk, controller) {
      count += chunk.length;
      arrived(chunk.length);
      controller.enqueue(chunk);
    },
  });
  try {
    const inflated = response.body!.pipeThrough(counter).pipeThrough(new DecompressionStream('deflate'));
    return unpack(new Uint8Array(await new Response(inflated).arrayBuffer()), element);
  } catch (error) {
    arrived(-count);
    if (signal?.aborted) throw error;
    throw new Error(`${url} did not arrive whole`);
  }
}

/** A packed array, tried again where the network fails. @throws Error in words for people */
export async function fetchPacked(
  url: string,
  element: number,
  arrived: Arrived = () => {},
  signal?: AbortSignal,
): Promise<ArrayBuffer> {
  for (let attempt = 1; ; ++attempt) {
    try {
      return (await tryPacked(url, element, arrived, signal)).buffer;
    } catch (error) {
      if (signal?.aborted || attempt === kTries) throw error;
      await new Promise((wake) => setTimeout(wake, 300 * attempt));
    }
  }
}
