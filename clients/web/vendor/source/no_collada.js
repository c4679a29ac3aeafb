// urdf-loader names a loader of Collada files, which the page does without.
export class ColladaLoader {
  load(url, done, progress, failed) {
    failed(new Error(`${url} is a Collada file, which this page cannot draw`));
  }
}
