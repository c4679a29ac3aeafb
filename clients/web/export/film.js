// What a canvas shows while it plays, as a film.

const KINDS = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm', 'video/mp4'];
const PICTURES_A_SECOND = 30, BITS_A_SECOND = 8_000_000;

export class Film {
  /** @param {HTMLCanvasElement} canvas throws an Error with a sentence where the browser records none; films from now on */
  constructor(canvas) {
    const kind = globalThis.MediaRecorder && canvas.captureStream && KINDS.find((one) => MediaRecorder.isTypeSupported(one));
    if (!kind) throw new Error('this browser records no film of a picture: Chromium, Firefox and Safari 14.1 do');
    this.kind = kind.split(';')[0];
    this.pieces = [];
    this.stream = canvas.captureStream(PICTURES_A_SECOND);
    this.recorder = new MediaRecorder(this.stream, {mimeType: kind, videoBitsPerSecond: BITS_A_SECOND});
    this.recorder.ondataavailable = ({data}) => this.pieces.push(data);
    this.recorder.start(1000);
  }

  /** @returns {string} of the file's name */
  get extension() {
    return this.kind === 'video/mp4' ? 'mp4' : 'webm';
  }

  /** @returns {Promise<Blob>} all of it; throws an Error with a sentence where no picture came in time */
  stop() {
    return new Promise((resolve, reject) => {
      this.recorder.onstop = () => {
        for (const track of this.stream.getTracks()) track.stop();
        const film = new Blob(this.pieces, {type: this.kind});
        if (film.size > 0) resolve(film);
        else reject(new Error('the film was over before its first picture: let it play longer'));
      };
      this.recorder.stop();
    });
  }
}
