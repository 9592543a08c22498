//! What goes back: documents, errors, and the headers of every response.

use std::convert::Infallible;
use std::pin::Pin;
use std::task::{Context, Poll};

use bytes::Bytes;
use hyper::body::{Body, Frame, SizeHint};
use hyper::header::{
    ALLOW, CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderName, HeaderValue,
    REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use hyper::{Response, StatusCode};
use serde::Serialize;
use serde_json::{Map, Value, json};
use tokio::sync::mpsc::Receiver;

/// Why a request is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// The input is wrong.
    BadInput,
    /// The token is missing or wrong.
    Unauthorized,
    /// The request comes from elsewhere, or asks for what is not allowed.
    Forbidden,
    /// There is nothing of this name.
    NotFound,
    /// Not with this method.
    NotAllowed,
    /// A newer request has taken its place.
    Superseded,
    /// Too large.
    TooLarge,
    /// The body has another type.
    UnsupportedType,
    /// Too much at once.
    TooMany,
    /// A defect.
    Defect,
}

impl Status {
    pub(crate) fn code(self) -> StatusCode {
        match self {
            Self::BadInput => StatusCode::BAD_REQUEST,
            Self::Unauthorized => StatusCode::UNAUTHORIZED,
            Self::Forbidden => StatusCode::FORBIDDEN,
            Self::NotFound => StatusCode::NOT_FOUND,
            Self::NotAllowed => StatusCode::METHOD_NOT_ALLOWED,
            Self::Superseded => StatusCode::CONFLICT,
            Self::TooLarge => StatusCode::PAYLOAD_TOO_LARGE,
            Self::UnsupportedType => StatusCode::UNSUPPORTED_MEDIA_TYPE,
            Self::TooMany => StatusCode::TOO_MANY_REQUESTS,
            Self::Defect => StatusCode::INTERNAL_SERVER_ERROR,
        }
    }
}

/// An error as the page shows it: what, where, and the remedy.
#[derive(Debug, Clone, Serialize)]
pub struct Refusal {
    /// Its status.
    #[serde(skip)]
    pub status: Status,
    /// One word, such as `value`, `token`, `superseded`.
    pub kind: &'static str,
    /// The option that it is about.
    pub key: Option<Box<str>>,
    /// The file, by the name that the user gave it.
    pub file: Option<Box<str>>,
    /// The line in it.
    pub line: Option<u32>,
    /// What is wrong.
    pub message: Box<str>,
    /// What to do.
    pub hint: Box<str>,
    /// Further problems of the same request.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<Refusal>,
}

impl Refusal {
    /// A refusal that is about no option and no file.
    pub fn new(
        status: Status,
        kind: &'static str,
        message: impl Into<Box<str>>,
        hint: impl Into<Box<str>>,
    ) -> Self {
        let (message, hint) = (message.into(), hint.into());
        Self {
            status,
            kind,
            key: None,
            file: None,
            line: None,
            message,
            hint,
            others: Vec::new(),
        }
    }

    /// The request was stopped because a newer one has taken its place.
    pub fn superseded() -> Self {
        Self::new(
            Status::Superseded,
            "superseded",
            "a newer request has taken its place",
            "use the newer answer",
        )
    }

    /// The document of this error.
    pub(crate) fn document(&self) -> Value {
        json!({ "error": self })
    }
}

/// The rows of a document as one array for each column, with `null` where a row lacks the column,
/// as [`Shape::Columns`](crate::Shape::Columns) asks. A value that is not a list of rows is left as
/// it is.
pub fn columns(rows: &Value) -> Value {
    let Some(list) = rows.as_array() else {
        return rows.clone();
    };
    let mut columns: Map<String, Value> = Map::new();
    for (place, row) in list.iter().enumerate() {
        for (name, value) in row.as_object().into_iter().flatten() {
            let column = columns
                .entry(name.clone())
                .or_insert_with(|| Value::Array(vec![Value::Null; place]));
            if let Some(column) = column.as_array_mut() {
                column.resize(place, Value::Null);
                column.push(value.clone());
            }
        }
    }
    for column in columns.values_mut() {
        if let Some(column) = column.as_array_mut() {
            column.resize(list.len(), Value::Null);
        }
    }
    Value::Object(columns)
}

/// The body of a response: a text that is complete, or one that is sent as it comes.
pub(crate) enum Content {
    Whole(Option<Bytes>),
    Stream(Receiver<Bytes>),
}

impl Body for Content {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        match self.get_mut() {
            Self::Whole(bytes) => Poll::Ready(bytes.take().map(|bytes| Ok(Frame::data(bytes)))),
            Self::Stream(receiver) => receiver
                .poll_recv(context)
                .map(|bytes| bytes.map(|bytes| Ok(Frame::data(bytes)))),
        }
    }

    fn is_end_stream(&self) -> bool {
        matches!(self, Self::Whole(None))
    }

    fn size_hint(&self) -> SizeHint {
        match self {
            Self::Whole(bytes) => {
                SizeHint::with_exact(bytes.as_ref().map_or(0, |bytes| bytes.len() as u64))
            }
            Self::Stream(_) => SizeHint::default(),
        }
    }
}

pub(crate) type Answered = Response<Content>;

/// The page may load its own scripts, styles and pictures, and nothing else from anywhere.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
                      font-src 'self'; connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors 'none'";

/// A response with the headers that every one has.
pub(crate) fn response(
    status: StatusCode,
    content_type: &'static str,
    content: Content,
) -> Answered {
    let mut response = Response::new(content);
    *response.status_mut() = status;
    let headers = response.headers_mut();
    let fixed = |text| HeaderValue::from_static(text);
    headers.insert(CONTENT_TYPE, fixed(content_type));
    headers.insert(CONTENT_SECURITY_POLICY, fixed(POLICY));
    headers.insert(X_CONTENT_TYPE_OPTIONS, fixed("nosniff"));
    headers.insert(REFERRER_POLICY, fixed("no-referrer"));
    headers.insert(
        HeaderName::from_static("cross-origin-opener-policy"),
        fixed("same-origin"),
    );
    headers.insert(
        HeaderName::from_static("cross-origin-resource-policy"),
        fixed("same-origin"),
    );
    headers.insert(CACHE_CONTROL, fixed("no-store"));
    response
}

/// A JSON document.
pub(crate) fn document(status: StatusCode, text: impl Into<Bytes>) -> Answered {
    response(
        status,
        "application/json",
        Content::Whole(Some(text.into())),
    )
}

/// A value as a JSON document.
pub(crate) fn value(status: StatusCode, value: &Value) -> Answered {
    document(status, value.to_string())
}

/// An error as a JSON document.
pub(crate) fn refused(refusal: &Refusal) -> Answered {
    value(refusal.status.code(), &refusal.document())
}

/// 405, with the methods that there are.
pub(crate) fn not_allowed(methods: &'static str) -> Answered {
    let hint = format!("use {methods}");
    let mut answer = refused(&Refusal::new(
        Status::NotAllowed,
        "method",
        "this address has no such method",
        hint,
    ));
    answer
        .headers_mut()
        .insert(ALLOW, HeaderValue::from_static(methods));
    answer
}

/// 204.
pub(crate) fn nothing() -> Answered {
    response(
        StatusCode::NO_CONTENT,
        "application/json",
        Content::Whole(None),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_become_columns() {
        let rows = json!([{"a": 1, "b": 2}, {"a": 3}, {"a": 4, "c": 5}]);
        assert_eq!(
            columns(&rows),
            json!({"a": [1, 3, 4], "b": [2, null, null], "c": [null, null, 5]})
        );
    }
}
