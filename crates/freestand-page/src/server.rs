//! The socket: bound to 127.0.0.1, and to nothing else.

use std::convert::Infallible;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::net::TcpListener;
use tokio::runtime::Runtime;
use tokio_io_timeout::TimeoutStream;

use crate::Program;
use crate::guard::{Guard, Token};
use crate::routes::{Site, answer};

/// Threads that handle connections; the work has its own.
const THREADS: usize = 2;

/// Threads on which requests and jobs wait for their work.
const BLOCKING_THREADS: usize = 48;

/// Connections at the same time.
const MAX_CONNECTIONS: usize = 128;

/// How long the head of a request may take.
const HEAD_TIME: Duration = Duration::from_secs(10);

/// How long a client may leave unread what is written to it.
const WRITE_TIME: Duration = Duration::from_secs(15);

/// How often it is looked whether the server is to end.
const LOOK: Duration = Duration::from_millis(50);

/// How long jobs may take to stop at the end.
const LAST_TIME: Duration = Duration::from_secs(5);

/// Why a server cannot be started.
#[derive(Debug)]
pub enum BindError {
    /// The port, or the network.
    Port(std::io::Error),
    /// The folder for temporary files.
    Folder(std::io::Error),
}

/// How to serve.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// The port; 0: any free one.
    pub port: u16,
    /// Where the results of jobs are kept; `None`: in a temporary folder, until the end.
    pub folder: Option<PathBuf>,
}

/// A server that listens, and does not answer yet.
pub struct Server {
    runtime: Runtime,
    listener: TcpListener,
    site: Arc<Site>,
    port: u16,
    token: Token,
}

impl Server {
    /// Listens on 127.0.0.1.
    ///
    /// # Errors
    /// The port is taken, or no temporary folder can be made.
    pub fn bind(settings: &Settings, program: Program) -> Result<Self, BindError> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(THREADS)
            .max_blocking_threads(BLOCKING_THREADS)
            .enable_io()
            .enable_time()
            .build()
            .map_err(BindError::Port)?;
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, settings.port));
        let listener = runtime
            .block_on(TcpListener::bind(address))
            .map_err(BindError::Port)?;
        let port = listener.local_addr().map_err(BindError::Port)?.port();
        let token = Token::random().map_err(BindError::Port)?;
        let site = Site::new(
            program,
            Guard::new(port, token.clone()),
            settings.folder.clone(),
        );
        let site = Arc::new(site.map_err(BindError::Folder)?);
        Ok(Self {
            runtime,
            listener,
            site,
            port,
            token,
        })
    }

    /// The port.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// The secret of the address.
    pub fn token(&self) -> &str {
        self.token.text()
    }

    /// The address to open: the token is behind the `#`, which no browser sends.
    pub fn url(&self) -> String {
        format!("http://127.0.0.1:{}/#{}", self.port, self.token())
    }

    /// An address that opens the page once, for the command line of a browser.
    ///
    /// # Errors
    /// The operating system gives no random numbers.
    pub fn url_for_browser(&self) -> std::io::Result<String> {
        Ok(format!(
            "http://127.0.0.1:{}/open/{}",
            self.port,
            self.site.guard.new_once()?.text()
        ))
    }

    /// The folder of the uploaded files: no request names a file elsewhere.
    pub fn uploads(&self) -> &Path {
        self.site.uploads.folder()
    }

    /// Answers until `wants_to_stop`; then jobs end at their next object.
    pub fn serve(self, wants_to_stop: impl Fn() -> bool) {
        let Self {
            runtime,
            listener,
            site,
            ..
        } = self;
        let accepting = runtime.spawn(accept(listener, Arc::clone(&site)));
        while !wants_to_stop() {
            std::thread::sleep(LOOK);
        }
        accepting.abort();
        site.jobs.cancel_all();
        let waited = std::time::Instant::now();
        while !site.jobs.is_idle() && waited.elapsed() < LAST_TIME {
            std::thread::sleep(LOOK);
        }
        runtime.shutdown_timeout(Duration::from_millis(200));
        // Work that is still going on holds the files.
        site.uploads.remove();
    }
}

async fn accept(listener: TcpListener, site: Arc<Site>) {
    let room = Arc::new(tokio::sync::Semaphore::new(MAX_CONNECTIONS));
    loop {
        let Ok(place) = Arc::clone(&room).acquire_owned().await else {
            return;
        };
        let Ok((stream, _)) = listener.accept().await else {
            // No more open files, for example: the next connection may find one.
            tokio::time::sleep(LOOK).await;
            continue;
        };
        let _ = stream.set_nodelay(true);
        let site = Arc::clone(&site);
        tokio::spawn(async move {
            let service = service_fn(move |request| {
                let site = Arc::clone(&site);
                async move { Ok::<_, Infallible>(answer(site, request).await) }
            });
            // Whoever does not read what is written to them gives their place to others.
            let mut stream = TimeoutStream::new(stream);
            stream.set_write_timeout(Some(WRITE_TIME));
            let mut builder = http1::Builder::new();
            builder
                .timer(TokioTimer::new())
                .header_read_timeout(HEAD_TIME);
            // A connection that breaks off concerns nobody else.
            let _ = builder
                .serve_connection(TokioIo::new(Box::pin(stream)), service)
                .await;
            drop(place);
        });
    }
}
