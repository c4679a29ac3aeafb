// What a canvas shows while it plays, as a film.

const KINDS = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm', 'video/mp4'];
const PICTURES_A_SECOND = 30, BITS_A_SECOND = 8_000_000, PIECE_MS = 200;

export class Film {
  /** @param {HTMLCanvasElement} canvas throws an Error with a sentence where the browser records none; films from now on */
  constructor(canvas) {
    const kind = globalThis.MediaRecorder && canvas.captureStream && KINDS.find((one) => MediaRecorder.isTypeSupported(one));
    if (!kind) throw new Error('this browser records no film of a picture: Chromium, Firefox and Safari 14.1 do');
    this.kind = kind.split(';')[0];
    this.pieces = [];
    this.stream = canvas.captureStream(PICTURES_A_SECOND);
    this.recorder = new MediaRecorder(this.stream, {mimeType: kind, videoBitsPerSecond: BITS_A_SECOND});
    /** the first picture is in it: what is drawn from now on is filmed */
    this.begun = new Promise((tell) => {
      this.recorder.ondataavailable = ({data}) => {
        this.pieces.push(data);
        if (data.size > 0) tell(undefined);
      };
    });
    this.recorder.start(PIECE_MS);
  }

  /** @returns {string} of the file's name */
  get extension() {
    return this.kind === 'video/mp4' ? 'mp4' : 'webm';
  }

  /** @returns {Promise<Blob>} all of it */
  stop() {
    return new Promise((resolve) => {
      this.recorder.onstop = () => {
        for (const track of this.stream.getTracks()) track.stop();
        resolve(new Blob(this.pieces, {type: this.kind}));
      };
      this.recorder.stop();
    });
  }
}
