// What `tsc` needs to know of the page's modules: the answers of the server, and what browsers have that its own library lacks.

/** Where textures come from, what they may become (`src/about.rs`). */
interface About {
  version: string;
  exported: boolean;
  opens: boolean;
  prompts: boolean;
  library: { id: string; name: string; textures: number } | null;
  folder: string | null;
  words: string[];
  sliders: { axis: string; unit: string; attribute: string; low: number; high: number; up: string; down: string }[];
  exports: { ending: string; format: string; file_ending: string }[];
  files: string[] | null;
  compiler: { file: string; bytes: number } | null;
  device: any;
  project: string | null;
}

/** A texture (`src/texture.rs`). */
interface Texture {
  id: string;
  name: string;
  seed: number;
  asset_bytes: number;
  model_rate_hz: number;
  worklet_rate_hz: number;
  preview: { pixels: number; width_mm: number };
  /** As `asperity inspect --json` prints it. */
  inspect: any;
  /** The report of a prompt. */
  compiled: any;
  /** The report of an edit, a mixture or an import. */
  made: any;
  places: Record<string, number | null>;
  editable: boolean;
  certainty: "known" | "close" | "guess" | "no_contact" | null;
  file: string;
  command: string | null;
  link: string | null;
}

/** The textures of a library, a list for each figure (`src/row.rs`). */
interface Columns {
  id: string;
  name: string;
  textures: string[] | null;
  names: string[];
  prompts: (string | null)[];
  notes?: string[];
  rough_db: (number | null)[];
  sharp_hz: (number | null)[];
  hard_hz: (number | null)[];
  mu: number[];
  certainty: (string | null)[];
}

/** A texture by its name on the server, whatever else is known of it. */
type Named = Pick<Texture, "id">;

// Of AudioWorklets.
declare const sampleRate: number;
declare const currentTime: number;
declare function registerProcessor(name: string, processor: typeof AudioWorkletProcessor): void;
declare class AudioWorkletProcessor {
  readonly port: MessagePort;
  constructor(options?: any);
}

// Of browsers that can choose a device.
interface AudioContext {
  setSinkId?(sink: string): Promise<void>;
  onerror: (() => void) | null;
}
interface MediaDevices {
  selectAudioOutput?(): Promise<MediaDeviceInfo>;
}
