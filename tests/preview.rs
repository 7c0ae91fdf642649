//! `--preview` against a listener that reads tev's protocol, and without anyone who listens.

mod common;

use common::command::{folder, refused};

const SCENE: &str = r#"
render = { width = 6, height = 4, samples = 40 }
camera = { position = [0, -10, 0], look_at = [0, 0, 0], fov = 25 }
picture = { exposure = 7 }
environment.constant = { spectrum = "D50", luminance = 100 }
[[objects]]
material = "gold"
shape.sphere = { radius = 3 }
"#;

#[cfg(not(feature = "preview"))]
#[test]
fn without_the_feature_it_says_how_to_get_it() {
    let folder = folder(&[("a.toml", SCENE)]);
    let message = refused(folder.path(), &["a.toml", "--preview"]);
    assert!(message.contains("--features preview"), "{message}");
}

#[cfg(feature = "preview")]
mod with_tev {
    use super::*;
    use common::command::run;
    use std::fs;
    use std::io::Read;
    use std::net::{TcpListener, TcpStream};
    use std::thread::JoinHandle;

    /// A packet's type and its content, after the layout in tev's README and `Ipc.cpp`.
    struct Packet {
        kind: u8,
        content: Vec<u8>,
        at: usize,
    }

    impl Packet {
        fn bytes<const N: usize>(&mut self) -> [u8; N] {
            self.at += N;
            self.content[self.at - N..self.at].try_into().expect("enough bytes")
        }

        fn flag(&mut self) -> bool {
            self.bytes::<1>()[0] != 0
        }

        fn int(&mut self) -> i32 {
            i32::from_le_bytes(self.bytes())
        }

        fn long(&mut self) -> i64 {
            i64::from_le_bytes(self.bytes())
        }

        fn text(&mut self) -> String {
            let length = self.content[self.at..].iter().position(|byte| *byte == 0).expect("a zero");
            let text = String::from_utf8(self.content[self.at..self.at + length].to_vec()).expect("text");
            self.at += length + 1;
            text
        }

        fn floats(&mut self) -> Vec<f32> {
            let rest = &self.content[self.at..];
            rest.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four"))).collect()
        }
    }

    fn packets(mut stream: TcpStream) -> Vec<Packet> {
        let mut packets = Vec::new();
        let mut length = [0; 4];
        while stream.read_exact(&mut length).is_ok() {
            let mut rest = vec![0; u32::from_le_bytes(length) as usize - 4];
            stream.read_exact(&mut rest).expect("a whole packet");
            packets.push(Packet { kind: rest[0], content: rest, at: 1 });
        }
        packets
    }

    /// A port of its own, and what is sent there.
    fn tev() -> (String, JoinHandle<Vec<Packet>>) {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let host = listener.local_addr().expect("an address").to_string();
        (host, std::thread::spawn(move || packets(listener.accept().expect("a client").0)))
    }

    #[test]
    fn tev_gets_the_picture_in_the_end() {
        let folder = folder(&[("ring.toml", SCENE)]);
        let (host, tev) = tev();
        let args = ["ring.toml", "-q", "-o", "a.exr", &format!("--preview={host}")];
        run(folder.path(), &args);
        let mut packets = tev.join().expect("packets");
        assert!(packets.len() >= 3, "created, shown after the first pass, shown in the end: {}", packets.len());
        let (create, updates) = packets.split_first_mut().expect("packets");
        assert_eq!((create.kind, create.flag(), create.text()), (4, true, "ring".to_owned()));
        assert_eq!([create.int(), create.int(), create.int()], [6, 4, 3]);
        assert_eq!([create.text(), create.text(), create.text()], ["R", "G", "B"]);
        let last = updates.last_mut().expect("an update");
        assert_eq!((last.kind, last.flag(), last.text(), last.int()), (6, false, "ring".to_owned(), 3));
        assert_eq!([last.text(), last.text(), last.text()], ["R", "G", "B"]);
        assert_eq!([last.int(), last.int(), last.int(), last.int()], [0, 0, 6, 4]);
        assert_eq!([0; 6].map(|_| last.long()), [0, 1, 2, 3, 3, 3]);
        assert_eq!(last.floats(), pixels(&folder.path().join("a.exr")));
    }

    /// R, G, B of all pixels of an EXR.
    fn pixels(path: &std::path::Path) -> Vec<f32> {
        let image = exr::prelude::read_first_rgba_layer_from_file(
            path,
            |size, _| vec![0.0; 3 * size.area()],
            |pixels: &mut Vec<f32>, at, (r, g, b, _): (f32, f32, f32, f32)| {
                let start = 3 * (at.1 * 6 + at.0);
                pixels[start..start + 3].copy_from_slice(&[r, g, b]);
            },
        );
        image.expect("an EXR").layer_data.channel_data.pixels
    }

    #[test]
    fn a_preview_changes_nothing_in_the_picture() {
        let folder = folder(&[("a.toml", SCENE)]);
        let (host, tev) = tev();
        run(folder.path(), &["a.toml", "-q", "-o", "with.exr", &format!("--preview={host}")]);
        run(folder.path(), &["a.toml", "-q", "-o", "without.exr"]);
        tev.join().expect("packets");
        let file = |name: &str| fs::read(folder.path().join(name)).expect("a picture");
        assert!(file("with.exr") == file("without.exr"));
    }

    #[test]
    fn without_tev_nothing_is_rendered() {
        let folder = folder(&[("a.toml", SCENE)]);
        // A port that was free a moment ago.
        let host = TcpListener::bind("127.0.0.1:0").expect("a port").local_addr().expect("an address").to_string();
        let message = refused(folder.path(), &["a.toml", &format!("--preview={host}")]);
        assert!(message.contains(&format!("no tev answers at {host}")) && message.contains("start tev"), "{message}");
        assert!(refused(folder.path(), &["a.toml", "--preview=nonsense"]).contains("nonsense"));
        assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 1);
    }

    #[test]
    fn a_tev_that_is_closed_does_not_end_the_render() {
        let folder = folder(&[("a.toml", SCENE)]);
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let host = listener.local_addr().expect("an address").to_string();
        let closed = std::thread::spawn(move || drop(listener.accept().expect("a client")));
        let args = ["a.toml", "--width", "600", "-o", "a.png", &format!("--preview={host}")];
        let output = run(folder.path(), &args);
        closed.join().expect("closed");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains("tev is gone") && stderr.contains("wrote a.png"), "{stderr}");
    }
}
