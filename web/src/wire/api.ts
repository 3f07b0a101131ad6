/** The studio's files over HTTP: scenes, recordings and results. Every request carries the page's token. */

export const recordingPath = (name: string): string => `/api/recordings/${encodeURIComponent(name)}`;
export const resultPath = (name: string): string => `/api/results/${encodeURIComponent(name)}`;

export class ApiError extends Error {
  /** status: HTTP status of the answer; 0 without an answer. */
  constructor(
    message: string,
    readonly status = 0,
  ) {
    super(message);
  }
}

export type Fetch = (input: string, init?: RequestInit) => Promise<Response>;

export class Api {
  constructor(
    private readonly token: string,
    private readonly fetcher: Fetch = (input, init) => fetch(input, init),
  ) {}

  /** Throws ApiError with a message for the user if there is no answer, or a refusal. */
  async get(path: string, init: RequestInit = {}): Promise<Response> {
    let response: Response;
    try {
      const headers = { Authorization: `Bearer ${this.token}` };
      response = await this.fetcher(path, { ...init, headers });
    } catch (error) {
      if (error instanceof DOMException && error.name === "AbortError") throw error;
      throw new ApiError("The studio does not answer.");
    }
    if (!response.ok) throw new ApiError(await reasonOf(response), response.status);
    return response;
  }

  async json<T>(path: string): Promise<T> {
    return (await (await this.get(path)).json()) as T;
  }

  async remove(path: string): Promise<void> {
    await this.get(path, { method: "DELETE" });
  }

  /** Sends a file. The signal ends the request, also while the answer comes. */
  send(path: string, body: Blob, signal: AbortSignal): Promise<Response> {
    return this.get(path, { method: "POST", body, signal });
  }

  /** The URL of a link that the browser itself opens or saves. */
  address(path: string): string {
    return `${path}${path.includes("?") ? "&" : "?"}token=${encodeURIComponent(this.token)}`;
  }
}

async function reasonOf(response: Response): Promise<string> {
  const text = await response.text().catch(() => "");
  const body = text.startsWith("{") ? (JSON.parse(text) as { text?: string; error?: string }) : { text };
  const words = (body.text ?? body.error ?? "").trim();
  if (words && words.length < 300 && !words.startsWith("<")) return words;
  return response.status === 404 ? "There is no such file any more." : `The studio answers ${response.status}.`;
}
