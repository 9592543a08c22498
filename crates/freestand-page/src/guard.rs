//! Who may ask: only a page of this server, opened by who started it.
//!
//! A name that resolves to 127.0.0.1 does not help a page from elsewhere, because `Host` has to be
//! ours; nor does a form or a script of such a page, because `Origin` has to be ours and the token
//! is in no cookie.

use std::sync::{Arc, Mutex, PoisonError};

use hyper::header::{AUTHORIZATION, HOST, HeaderName, ORIGIN};
use hyper::{HeaderMap, Request};

use crate::assets::hex;
use crate::reply::{Refusal, Status};

/// Random bytes of a token.
const TOKEN_BYTES: usize = 32;

/// The secret that the page sends with each request, as 64 hexadecimal digits.
#[derive(Clone)]
pub(crate) struct Token(String);

impl Token {
    /// 256 bits from the operating system.
    pub(crate) fn random() -> std::io::Result<Self> {
        let mut bytes = [0u8; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(|error| std::io::Error::other(error.to_string()))?;
        Ok(Self(hex(&bytes)))
    }

    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Whether a text is the token. Every byte is compared: the time tells nothing about how many
    /// are right.
    fn is(&self, text: &[u8]) -> bool {
        let own = self.0.as_bytes();
        let different = own
            .iter()
            .zip(text)
            .fold(0u8, |all, (a, b)| std::hint::black_box(all | (a ^ b)));
        text.len() == own.len() && different == 0
    }
}

/// The addresses at which this server is.
#[derive(Clone)]
pub(crate) struct Guard {
    hosts: Vec<String>,
    origins: Vec<String>,
    token: Token,
    /// Opens the page once: it is on the command line of the browser, where every user of the machine
    /// can read it, and is worth nothing afterwards.
    once: Arc<Mutex<Option<Token>>>,
}

/// The port that an address without one has: browsers leave it out.
const DEFAULT_PORT: u16 = 80;

impl Guard {
    pub(crate) fn new(port: u16, token: Token) -> Self {
        const NAMES: [&str; 2] = ["127.0.0.1", "localhost"];
        let bare = NAMES
            .iter()
            .filter(|_| port == DEFAULT_PORT)
            .map(|name| (*name).to_owned());
        let hosts: Vec<String> = NAMES
            .iter()
            .map(|name| format!("{name}:{port}"))
            .chain(bare)
            .collect();
        let origins = hosts.iter().map(|host| format!("http://{host}")).collect();
        Self {
            hosts,
            origins,
            token,
            once: Arc::default(),
        }
    }

    /// Refuses what comes from elsewhere; before anything else is looked at.
    pub(crate) fn check_origin<B>(&self, request: &Request<B>) -> Result<(), Refusal> {
        let forbidden = |kind: &'static str, message: &str| {
            Refusal::new(
                Status::Forbidden,
                kind,
                message,
                "open the address that freestand serve printed",
            )
        };
        let is_host = |text: &str| self.hosts.iter().any(|own| text.eq_ignore_ascii_case(own));
        let named = request
            .uri()
            .authority()
            .is_none_or(|authority| is_host(authority.as_str()));
        if !named || only(request.headers(), &HOST).is_none_or(|host| !is_host(host)) {
            return Err(forbidden("host", "the request names another host"));
        }
        let is_ours = |text: &str| self.origins.iter().any(|own| text == own);
        if request.headers().contains_key(ORIGIN)
            && only(request.headers(), &ORIGIN).is_none_or(|origin| !is_ours(origin))
        {
            return Err(forbidden("origin", "the request comes from another page"));
        }
        Ok(())
    }

    /// A new word that opens the page once, in place of an earlier one.
    pub(crate) fn new_once(&self) -> std::io::Result<Token> {
        let once = Token::random()?;
        *self.once.lock().unwrap_or_else(PoisonError::into_inner) = Some(once.clone());
        Ok(once)
    }

    /// The token, for whoever brings the word that opens the page once; the word is then used up.
    pub(crate) fn open(&self, once: &str) -> Option<&Token> {
        let mut kept = self.once.lock().unwrap_or_else(PoisonError::into_inner);
        kept.take_if(|kept| kept.is(once.as_bytes()))
            .map(|_| &self.token)
    }

    /// Refuses whoever asks the program without the token.
    pub(crate) fn check_token<B>(&self, request: &Request<B>) -> Result<(), Refusal> {
        let site = HeaderName::from_static("sec-fetch-site");
        if request.headers().contains_key(&site)
            && only(request.headers(), &site)
                .is_none_or(|site| !["same-origin", "none"].contains(&site))
        {
            let message = "the request comes from another site";
            return Err(Refusal::new(
                Status::Forbidden,
                "origin",
                message,
                "open the address that freestand serve printed",
            ));
        }
        let given =
            only(request.headers(), &AUTHORIZATION).and_then(|text| text.strip_prefix("Bearer "));
        if given.is_some_and(|given| self.token.is(given.as_bytes())) {
            return Ok(());
        }
        let hint = "open the address that freestand serve printed, with everything after the #";
        Err(Refusal::new(
            Status::Unauthorized,
            "token",
            "the token is missing or wrong",
            hint,
        ))
    }
}

/// The value of a header that is there once.
fn only<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    let mut all = headers.get_all(name).iter();
    let first = all.next()?;
    if all.next().is_some() {
        None
    } else {
        first.to_str().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_port_may_be_left_out() {
        let asked = |port: u16, host: &str| {
            let guard = Guard::new(port, Token::random().unwrap());
            let request = Request::builder()
                .header(HOST, host)
                .header(ORIGIN, format!("http://{host}"));
            guard.check_origin(&request.body(()).unwrap()).is_ok()
        };
        for host in ["127.0.0.1", "localhost"] {
            assert!(asked(80, host) && asked(80, &format!("{host}:80")));
            assert!(
                !asked(8080, host)
                    && !asked(80, &format!("{host}:8080"))
                    && asked(8080, &format!("{host}:8080"))
            );
        }
        assert!(!asked(80, "example.org"));
    }

    #[test]
    fn the_page_is_opened_once() {
        let guard = Guard::new(8080, Token::random().unwrap());
        assert!(guard.open("").is_none());
        let (earlier, once) = (guard.new_once().unwrap(), guard.new_once().unwrap());
        assert!(guard.open(earlier.text()).is_none());
        assert_eq!(guard.open(once.text()).unwrap().text(), guard.token.text());
        assert!(guard.open(once.text()).is_none());
    }

    #[test]
    fn tokens_differ_and_are_compared_whole() {
        let (one, other) = (Token::random().unwrap(), Token::random().unwrap());
        assert_eq!(one.text().len(), 64);
        assert_ne!(one.text(), other.text());
        assert!(one.is(one.text().as_bytes()));
        assert!(!one.is(other.text().as_bytes()));
        assert!(!one.is(b"") && !one.is(&one.text().as_bytes()[..63]));
        assert!(!one.is(format!("{}0", one.text()).as_bytes()));
    }
}
