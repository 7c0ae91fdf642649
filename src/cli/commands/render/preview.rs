//! `--preview`: the picture in tev while it renders, over tev's network protocol.
//!
//! The picture is created under the scene's name and updated as samples come in, as linear RGB, at most twice a second; the render
//! goes on without it when tev is closed. Built with the feature `preview` alone, because few need it.

use crate::film::Developed;
use crate::scene::SceneError;

/// Where tev listens unless told otherwise.
pub const DEFAULT_HOST: &str = "127.0.0.1:14158";

pub use connection::Preview;

#[cfg(feature = "preview")]
mod connection {
    use super::{Developed, SceneError};
    use crate::cli::show;
    use std::io;
    use std::net::{TcpStream, ToSocketAddrs};
    use std::time::{Duration, Instant};
    use tev_client::{PacketCreateImage, PacketUpdateImage, TevClient};

    /// Between two updates, so that developing and sending stay a small part of the work.
    const INTERVAL: Duration = Duration::from_millis(500);

    /// A tev that does not answer or read for so long is not there.
    const PATIENCE: Duration = Duration::from_secs(5);

    const CHANNELS: [&str; 3] = ["R", "G", "B"];

    /// A connection to tev; without one once it is lost.
    pub struct Preview {
        client: Option<TevClient>,
        name: String,
        shown: Option<Instant>,
        /// Width and height of the picture that tev has.
        size: Option<[u32; 2]>,
    }

    impl Preview {
        pub fn connect(host: &str, name: &str) -> Result<Self, SceneError> {
            let client = open(host).map_err(|error| {
                let message = format!("--preview: no tev answers at {host}: {error}");
                SceneError::new(message).help("start tev first; it listens at 127.0.0.1:14158 unless told otherwise")
            })?;
            Ok(Self { client: Some(client), name: name.to_owned(), shown: None, size: None })
        }

        /// Whether it is time to show what there is.
        pub fn is_due(&self) -> bool {
            self.client.is_some() && self.shown.is_none_or(|shown| shown.elapsed() >= INTERVAL)
        }

        pub fn show(&mut self, developed: &Developed) {
            let Some(client) = &mut self.client else { return };
            let size = [developed.width(), developed.height()];
            let created = if self.size == Some(size) { Ok(()) } else { create(client, &self.name, size) };
            match created.and_then(|()| update(client, &self.name, size, developed)) {
                Ok(()) => self.size = Some(size),
                Err(error) => {
                    show::warning(format_args!("tev is gone ({error}): no more preview"));
                    self.client = None;
                }
            }
            self.shown = Some(Instant::now());
        }
    }

    fn open(host: &str) -> io::Result<TevClient> {
        let mut failed = io::Error::new(io::ErrorKind::NotFound, "no such host");
        for address in host.to_socket_addrs()? {
            match TcpStream::connect_timeout(&address, PATIENCE) {
                Ok(stream) => {
                    stream.set_write_timeout(Some(PATIENCE))?;
                    return Ok(TevClient::wrap(stream));
                }
                Err(error) => failed = error,
            }
        }
        Err(failed)
    }

    fn create(client: &mut TevClient, image_name: &str, [width, height]: [u32; 2]) -> io::Result<()> {
        client.send(PacketCreateImage { image_name, grab_focus: true, width, height, channel_names: &CHANNELS })
    }

    fn update(client: &mut TevClient, image_name: &str, size: [u32; 2], developed: &Developed) -> io::Result<()> {
        client.send(PacketUpdateImage {
            image_name,
            grab_focus: false,
            channel_names: &CHANNELS,
            channel_offsets: &[0, 1, 2],
            channel_strides: &[3, 3, 3],
            x: 0,
            y: 0,
            width: size[0],
            height: size[1],
            data: developed.rgb.as_flattened(),
        })
    }
}

#[cfg(not(feature = "preview"))]
mod connection {
    use super::{Developed, SceneError};

    /// There is none without the feature.
    pub enum Preview {}

    impl Preview {
        pub fn connect(_host: &str, _name: &str) -> Result<Self, SceneError> {
            let message = "--preview: this spectrel was built without the preview";
            Err(SceneError::new(message).help("build it with `cargo install --path . --features preview`"))
        }

        pub fn is_due(&self) -> bool {
            match *self {}
        }

        pub fn show(&mut self, _developed: &Developed) {
            match *self {}
        }
    }
}
